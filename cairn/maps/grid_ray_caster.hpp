#pragma once

#include "cairn/maps/occupancy_grid.hpp"

namespace cairn {

/// Which cells end a ray. Off the grid nothing does.
enum class RayStop { kOccupied, kOccupiedOrUnknown };

constexpr bool is_stop(CellState state, RayStop stop) {
  return state == CellState::kOccupied ||
         (stop == RayStop::kOccupiedOrUnknown && state == CellState::kUnknown);
}

/// Distance (m) from the ray's origin, along its heading, to where it enters the first cell that stops it;
/// `max_range_m` if it meets none before. 0 if it starts in such a cell. A ray from outside the grid may
/// enter it. Exact: every cell that the ray touches is visited (Amanatides & Woo, "A Fast Voxel Traversal
/// Algorithm for Ray Tracing", 1987), in double precision. The oracle of RayMarcher.
/// @pre max_range_m >= 0; a ray that is not finite gives `max_range_m`
double cast_ray(const OccupancyGrid& grid, const Pose2& T_map_ray, double max_range_m,
                RayStop stop = RayStop::kOccupied);

}  // namespace cairn
