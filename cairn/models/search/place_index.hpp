#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/core/rng.hpp"
#include "cairn/maps/occupancy_grid.hpp"
#include "cairn/models/search/scan_signature.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace cairn {

struct PlaceIndexOptions {
  double spacing_m = 0.5;       ///< between positions
  int headings = 36;            ///< per position
  int most_places = 1'000'000;  ///< on a larger map the spacing grows, so that there are no more
  friend bool operator==(const PlaceIndexOptions&, const PlaceIndexOptions&) = default;
};

/// What a laser scanner would see all over a map: the simulated signatures of its poses on a grid of
/// positions in free space and headings, in a kd-tree (offline; Thrun et al. 2001, section 4). Given a scan
/// it tells where something like it is seen. Immutable; may be used from several threads at once.
class PlaceIndex {
 public:
  /// One cell of the grid.
  struct Place {
    Pose2 T_map_sensor;  ///< its middle, a free place of the map
  };
  struct Neighbour {
    std::uint32_t place = 0;
    float distance_m = 0.0F;  ///< between the signatures: root of the mean squared difference per sector
  };

  /// Simulates all signatures. @param on_progress told the share done, 0..1
  /// @throws ConfigurationError for a shape that is none, and if the map has no free cell
  PlaceIndex(const OccupancyGrid& map, const SignatureShape& shape, const PlaceIndexOptions& options,
             const std::function<void(double)>& on_progress = {});
  /// From what an index of the same map, shape and options holds. @pre signatures.size() == number of places
  PlaceIndex(const OccupancyGrid& map, const SignatureShape& shape, const PlaceIndexOptions& options,
             std::vector<ScanSignature> signatures);
  ~PlaceIndex();
  PlaceIndex(const PlaceIndex&) = delete;
  PlaceIndex& operator=(const PlaceIndex&) = delete;

  std::size_t size() const { return signatures_.size(); }
  const SignatureShape& shape() const { return shape_; }
  const std::vector<ScanSignature>& signatures() const { return signatures_; }
  double spacing_m() const { return spacing_m_; }
  double heading_step_rad() const;
  int headings() const { return headings_; }
  Place place(std::size_t index) const;

  /// The `count` places whose signatures are the most alike, the nearest first.
  std::vector<Neighbour> nearest(const ScanSignature& signature, std::size_t count) const;

  /// A pose uniform over the cell of a place.
  /// @param item of `random`, draw 2
  Pose2 sample(std::size_t place, const RandomStream& random, std::uint32_t item) const;

  /// How many places an index of this map would have.
  static std::size_t places_on(const OccupancyGrid& map, const PlaceIndexOptions& options);

 private:
  struct Tree;
  void simulate(const OccupancyGrid& map, const std::function<void(double)>& on_progress);
  void plant();

  SignatureShape shape_;
  double spacing_m_;
  int headings_;
  std::vector<Point2> positions_;
  std::vector<ScanSignature> signatures_;  ///< of position i and heading h: [i * headings + h]
  std::unique_ptr<const Tree> tree_;
};

}  // namespace cairn
