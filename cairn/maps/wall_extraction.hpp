#pragma once

#include "cairn/maps/occupancy_grid.hpp"
#include "cairn/maps/vector_map.hpp"

namespace cairn {

struct WallExtractionOptions {
  double tolerance_cells = 1.2;   ///< most that a cell may lie off its wall
  double min_length_cells = 3.0;  ///< shorter walls are left out
  double max_angle_rad = 0.45;    ///< between a wall and the direction of the obstacle's border at a cell
};

/// Finds the straight walls of an occupancy grid.
///
/// The centres of occupied cells beside free space are the points; each knows the direction of the border
/// around it. Starting where the border is straightest, a wall grows from cell to neighbouring cell as long
/// as they lie on its line, which is fitted again on the way (total least squares): region growing as in the
/// line segment detector of Grompone von Gioi et al., IPOL 2012. The walls run through cell centres, as the
/// distances of a DistanceField do, and reach half a cell beyond their outermost ones. A wall of one or two
/// cells' width gives one line.
/// @throws InputError if the grid has no wall of that length
VectorMap extract_walls(const OccupancyGrid& grid, const WallExtractionOptions& options = {});

}  // namespace cairn
