#pragma once

#include "cairn/maps/wall_grid.hpp"

#include <limits>

namespace cairn {

/// Where a ray meets the first wall.
struct RayHit {
  double range_m = std::numeric_limits<double>::infinity();
  std::uint32_t wall = kNoWall;  ///< index in VectorMap::walls()

  explicit operator bool() const { return wall != kNoWall; }
};

/// The first wall on a ray, exactly: the grid is only walked to leave walls out (Amanatides & Woo, "A Fast
/// Voxel Traversal Algorithm for Ray Tracing", 1987). Rays do not slip through where two walls share an end
/// point. A wall that is seen edge-on is not seen; of walls at equal range any one is named.
/// @param direction  of unit length; a direction or an origin that is not finite meets nothing
/// @param max_range_m  walls beyond are not met
RayHit cast_ray(const WallGrid& grid, const Point2& origin, const Point2& direction,
                double max_range_m = std::numeric_limits<double>::infinity());

/// The same by trying every wall of the map that `seen` contains: the plain reference.
RayHit cast_ray_by_brute_force(const VectorMap& map, MaterialSet seen, const Point2& origin,
                               const Point2& direction,
                               double max_range_m = std::numeric_limits<double>::infinity());

}  // namespace cairn
