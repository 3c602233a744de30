#pragma once

#include "cairn/maps/occupancy_grid.hpp"
#include "cairn/maps/vector_map.hpp"

#include <vector>

namespace cairn {

/// The edges between occupied cells and all others, as opaque walls in the map frame, neighbouring edges
/// joined: a beam is returned exactly where it enters an occupied cell.
std::vector<Wall> walls_of_grid(const OccupancyGrid& grid);

}  // namespace cairn
