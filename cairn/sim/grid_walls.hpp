#pragma once

#include "cairn/core/trajectory.hpp"
#include "cairn/maps/occupancy_grid.hpp"
#include "cairn/maps/vector_map.hpp"

#include <vector>

namespace cairn {

/// The edges between occupied cells and all others, as opaque walls in the map frame, neighbouring edges
/// joined: a beam is returned exactly where it enters an occupied cell.
std::vector<Wall> walls_of_grid(const OccupancyGrid& grid);

/// The grid with all cells free whose centres are nearer than `clear_m` to a pose of the path: a robot was
/// there.
OccupancyGrid cleared_along(const OccupancyGrid& grid, const Trajectory& path, double clear_m);

}  // namespace cairn
