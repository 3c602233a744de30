#include "cairn/maps/triangle_mesh.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <Eigen/Geometry>

namespace cairn {
namespace {

// A face whose height is less than this share of its longest edge is no surface to walk on.
constexpr double kThinnest = 1e-9;

std::string place(const std::string& name, std::size_t face) {
  return name + ": face " + std::to_string(face);
}

}  // namespace

TriangleMesh::TriangleMesh(std::vector<Eigen::Vector3d> vertices, std::vector<Face> faces,
                           const std::string& name)
    : vertices_(std::move(vertices)), faces_(std::move(faces)) {
  if (faces_.empty()) throw InputError(name, "has no face", "give triangles");
  check_and_measure(name);
  join_edges(name);
}

void TriangleMesh::check_and_measure(const std::string& name) {
  areas_.push_back(0.0);
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    for (const std::uint32_t v : faces_[i]) {
      if (v >= vertices_.size())
        throw InputError(place(name, i), "names vertex " + std::to_string(v),
                         "there are " + std::to_string(vertices_.size()) + ", counted from 0");
    }
    const Eigen::Vector3d &a = vertices_[faces_[i][0]], &b = vertices_[faces_[i][1]],
                          &c = vertices_[faces_[i][2]];
    const double twice_area = (b - a).cross(c - a).norm();
    const double longest = std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()});
    if (!std::isfinite(twice_area))
      throw InputError(place(name, i), "has a corner that is not finite", "check the vertices");
    if (!(twice_area > kThinnest * longest * longest))
      throw InputError(place(name, i), "has no area", "remove it and join its neighbours");
    const Eigen::Vector3d x = (b - a).normalized();
    const double along = x.dot(c - a);
    corners_.push_back({Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d((b - a).norm(), 0.0),
                        Eigen::Vector2d(along, twice_area / (b - a).norm())});
    areas_.push_back(areas_.back() + twice_area / 2.0);
  }
}

// Two faces that run around the same side pass their common edge in opposite directions.
void TriangleMesh::join_edges(const std::string& name) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Neighbour> edges;  // by (from, to)
  for (std::uint32_t i = 0; i < faces_.size(); ++i) {
    for (std::uint8_t k = 0; k < 3; ++k) {
      const std::pair key(faces_[i][(k + 1) % 3], faces_[i][(k + 2) % 3]);
      if (!edges.emplace(key, Neighbour{i, k}).second)
        throw InputError(place(name, i), "passes an edge in the same direction as another face",
                         "let all faces run counter-clockwise around the outside; two share an edge at most");
    }
  }
  neighbours_.resize(faces_.size());
  for (const auto& [key, side] : edges) {
    const auto other = edges.find({key.second, key.first});
    if (other != edges.end()) neighbours_[side.face][side.edge] = other->second;
  }
}

std::optional<TriangleMesh::Neighbour> TriangleMesh::across(std::uint32_t face, int edge) const {
  return neighbours_[face][static_cast<std::size_t>(edge)];
}

bool TriangleMesh::is_closed() const {
  return std::all_of(neighbours_.begin(), neighbours_.end(), [](const auto& around) {
    return std::all_of(around.begin(), around.end(), [](const auto& n) { return n.has_value(); });
  });
}

Eigen::Vector3d TriangleMesh::position(const SurfacePoint& point) const {
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) p += point.weights[k] * vertices_[faces_[point.face][k]];
  return p;
}

Eigen::Vector3d TriangleMesh::normal(std::uint32_t face) const {
  const Eigen::Vector3d& a = vertices_[faces_[face][0]];
  return (vertices_[faces_[face][1]] - a).cross(vertices_[faces_[face][2]] - a).normalized();
}

// The square root makes (v, w) uniform over the triangle (Turk, Graphics Gems 1990).
SurfacePoint TriangleMesh::at_random(double u, double v, double w) const {
  const auto after = std::upper_bound(areas_.begin() + 1, areas_.end(), u * area());
  const auto face =
      std::min<std::ptrdiff_t>(after - areas_.begin() - 1, static_cast<std::ptrdiff_t>(faces_.size()) - 1);
  const double root = std::sqrt(v);
  return {static_cast<std::uint32_t>(face), {1.0 - root, root * (1.0 - w), root * w}};
}

}  // namespace cairn
