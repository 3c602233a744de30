#pragma once

#include "cairn/core/executor.hpp"
#include "cairn/core/large_vector.hpp"
#include "cairn/maps/occupancy_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace cairn {

/// For every cell of a grid, the exact Euclidean distance from its centre to the centre of the nearest
/// occupied cell, cut at `max_distance_m`.
///
/// Held as squared numbers of cells: 2 bytes a cell while the largest distance is at most 255 cells (or the
/// grid's diagonal is), 4 beyond. Filled at about 1 ns a cell in the first case, 100 ns in the second.
class DistanceField {
 public:
  /// @throws ConfigurationError if `max_distance_m` is not positive.
  DistanceField(const OccupancyGrid& grid, double max_distance_m, const Executor& executor = Executor());

  const GridGeometry& geometry() const { return geometry_; }
  double max_distance_m() const { return max_distance_m_; }

  /// Metres; `index` as in GridGeometry::index.
  float distance_m(std::size_t index) const {
    const std::uint32_t squared = squared_cells(index);
    if (squared >= far_) return static_cast<float>(max_distance_m_);
    return static_cast<float>(std::sqrt(static_cast<double>(squared)) * geometry_.resolution_m);
  }
  /// Squared distance in cells; at least `far()` where it is `max_distance_m` or more.
  std::uint32_t squared_cells(std::size_t index) const {
    return wide_.empty() ? narrow_[index] : wide_[index];
  }
  std::uint32_t far() const { return far_; }

  /// All distances, metres, row by row like the grid's cells. A copy: for looks, not for loops.
  std::vector<float> all_distances_m() const;

 private:
  GridGeometry geometry_;
  double max_distance_m_;
  std::uint32_t far_;                  ///< squared cells
  LargeVector<std::uint16_t> narrow_;  ///< one of the two
  LargeVector<std::uint32_t> wide_;
};

}  // namespace cairn
