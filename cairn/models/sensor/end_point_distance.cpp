#include "cairn/models/sensor/end_point_distance.hpp"

#include <algorithm>

namespace cairn {

double share_near_walls(const DistanceField& field, std::span<const Point2> points, const Pose2& T_map_base,
                        double within_m) {
  const GridGeometry& grid = field.geometry();
  const auto is_near = [&](const Point2& p) {
    const Point2 cell = grid.to_cells(T_map_base * p);
    if (!(cell.x >= 0 && cell.x < grid.width && cell.y >= 0 && cell.y < grid.height)) return false;
    return field.distance_m(grid.index(static_cast<int>(cell.x), static_cast<int>(cell.y))) <= within_m;
  };
  const auto near = std::count_if(points.begin(), points.end(), is_near);
  return points.empty() ? 0.0 : static_cast<double>(near) / static_cast<double>(points.size());
}

}  // namespace cairn
