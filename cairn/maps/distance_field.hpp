#pragma once

#include "cairn/maps/occupancy_grid.hpp"

#include <vector>

namespace cairn {

/// For every cell of a grid, the exact Euclidean distance from its centre to the centre of the nearest
/// occupied cell, cut at `max_distance_m` (Felzenszwalb & Huttenlocher, "Distance Transforms of Sampled
/// Functions", 2012).
class DistanceField {
 public:
  /// @throws ConfigurationError if `max_distance_m` is not positive.
  DistanceField(const OccupancyGrid& grid, double max_distance_m);

  const GridGeometry& geometry() const { return geometry_; }
  double max_distance_m() const { return max_distance_m_; }
  /// Metres, row by row like the grid's cells.
  const std::vector<float>& distances_m() const { return distances_m_; }

 private:
  GridGeometry geometry_;
  double max_distance_m_;
  std::vector<float> distances_m_;
};

}  // namespace cairn
