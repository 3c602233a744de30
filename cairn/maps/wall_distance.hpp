#pragma once

#include "cairn/maps/vector_map.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace cairn {

/// Finds the nearest wall of a point, exactly, up to a largest distance.
///
/// A grid of cells knows which walls can be the nearest one to any of its points: those whose distance to the
/// centre exceeds the smallest by no more than the cell's diagonal. At most 4 million cells.
class WallDistance {
 public:
  /// @param max_distance_m  walls further away count as none
  /// @param cell_m  larger where the limit asks for it
  /// @throws ConfigurationError if `max_distance_m` is not positive and finite
  WallDistance(std::shared_ptr<const VectorMap> map, double max_distance_m, MaterialSet seen = kSeenByLaser,
               double cell_m = 0.25);

  const VectorMap& map() const { return *map_; }
  double max_distance_m() const { return max_distance_m_; }

  /// Nearest point of any wall, if it is within max_distance_m; none for a point that is not finite.
  std::optional<Point2> nearest(const Point2& point) const;

 private:
  void choose_cells(double cell_m);
  template <class Visit>
  void for_each_near(const Wall& wall, const Visit& visit) const;

  std::shared_ptr<const VectorMap> map_;
  double max_distance_m_;
  Point2 origin_;
  double cell_m_ = 1.0;
  int columns_ = 0, rows_ = 0;
  std::vector<std::uint32_t> first_;       ///< of each cell, in candidates_
  std::vector<std::uint32_t> candidates_;  ///< indices of walls
};

}  // namespace cairn
