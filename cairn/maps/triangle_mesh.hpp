#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace cairn {

/// A point on a triangle mesh: a face and the weights of its three corners, >= 0 and of sum 1.
struct SurfacePoint {
  std::uint32_t face = 0;
  std::array<double, 3> weights = {1.0, 0.0, 0.0};
  friend bool operator==(const SurfacePoint&, const SurfacePoint&) = default;
};

/// The surface of a body, as triangles that share edges. Immutable.
///
/// Each face has a frame of its own: origin at corner 0, x along the edge to corner 1, z along the normal,
/// which the corners run around counter-clockwise. Edge k of a face lies opposite corner k, from corner k + 1
/// to k + 2.
class TriangleMesh {
 public:
  using Face = std::array<std::uint32_t, 3>;  ///< indices of the corners among the vertices

  /// @param vertices metres
  /// @param name of the mesh in messages
  /// @throws InputError if there is no face, an index or a number is out of range, a face has no area, more
  ///   than two faces share an edge, or two neighbours do not run around the same side
  TriangleMesh(std::vector<Eigen::Vector3d> vertices, std::vector<Face> faces,
               const std::string& name = "mesh");

  std::size_t size() const { return faces_.size(); }
  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  const Face& face(std::uint32_t i) const { return faces_[i]; }

  /// Square metres.
  double area(std::uint32_t face) const { return areas_[face + 1] - areas_[face]; }
  double area() const { return areas_.back(); }

  /// What lies beyond an edge.
  struct Neighbour {
    std::uint32_t face;
    std::uint8_t edge;  ///< the same edge, as the neighbour counts it
  };
  /// nullopt at the border of an open mesh.
  std::optional<Neighbour> across(std::uint32_t face, int edge) const;
  /// True if no edge lies at a border.
  bool is_closed() const;

  /// Corner k of a face in the face's own frame, metres.
  const Eigen::Vector2d& corner(std::uint32_t face, int k) const { return corners_[face][k]; }

  /// In the frame of the vertices, metres.
  Eigen::Vector3d position(const SurfacePoint& point) const;
  Eigen::Vector3d normal(std::uint32_t face) const;

  /// A point uniform over the area, from three uniform numbers in (0, 1).
  SurfacePoint at_random(double u, double v, double w) const;

 private:
  void check_and_measure(const std::string& name);
  void join_edges(const std::string& name);

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<Face> faces_;
  std::vector<std::array<std::optional<Neighbour>, 3>> neighbours_;
  std::vector<std::array<Eigen::Vector2d, 3>> corners_;
  std::vector<double> areas_;  ///< cumulative: [i] is the area of all faces before i
};

}  // namespace cairn
