#include "cairn/maps/grid_ray_caster.hpp"

#include "cairn/maps/grid_ray_walk.hpp"

namespace cairn {

double cast_ray(const OccupancyGrid& grid, const Pose2& T_map_ray, double max_range_m, RayStop stop) {
  return walk_ray(grid.geometry(), T_map_ray, max_range_m, [&](int column, int row) {
    return is_stop(grid.state(grid.geometry().index(column, row)), stop);
  });
}

}  // namespace cairn
