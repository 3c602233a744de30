#pragma once

#include "cairn/maps/occupancy_grid.hpp"
#include "cairn/maps/vector_map.hpp"

#include <vector>

namespace cairn {

struct WallDrawingOptions {
  double resolution_m = 0.05;
  double margin_m = 0.5;            ///< of unknown cells around the walls
  MaterialSet seen = kSeenByLaser;  ///< walls of other materials are not drawn
  /// Free is what can be reached from these points without crossing a drawn wall. None: what cannot be
  /// reached from outside.
  std::vector<Point2> inside = {};
};

/// Draws a vector map into an occupancy grid: cells along walls are occupied (100), free ones 0, all others
/// unknown. The lines are one cell wide and have no gap that leads from a cell to one beside it. Points whose
/// coordinates are multiples of the resolution lie at cell centres.
/// @throws ConfigurationError for a resolution that is not positive, more than 2^30 cells, or a point of
///   `inside` that lies off the grid or in a wall
OccupancyGrid draw_walls(const VectorMap& map, const WallDrawingOptions& options);

}  // namespace cairn
