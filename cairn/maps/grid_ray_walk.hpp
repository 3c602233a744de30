#pragma once

#include "cairn/maps/occupancy_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn {
namespace ray_walk {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The ray along one axis, in cells: where it is, and at which length it enters the next cell.
struct Axis {
  // @param start where the ray is at length `at`
  Axis(double origin, double direction, double start, int cells)
      : step(direction > 0.0 ? 1 : -1), limit(cells), cell(static_cast<int>(std::floor(start))) {
    cell = std::clamp(cell, 0, cells - 1);  // rounding on the grid's edge
    if (direction == 0.0) return;
    next = (cell + (step > 0 ? 1 : 0) - origin) / direction;
    per_cell = std::abs(1.0 / direction);
  }
  bool advance() {
    cell += step;
    next += per_cell;
    return cell >= 0 && cell < limit;
  }

  int step;
  int limit;
  int cell;
  double next = kInfinity;
  double per_cell = kInfinity;
};

struct Stretch {
  double begin;
  double end;
};

// The part of the ray that lies within 0..cells along one axis.
inline Stretch within(double origin, double direction, int cells) {
  if (direction == 0.0)
    return origin >= 0.0 && origin < cells ? Stretch{0.0, kInfinity} : Stretch{kInfinity, -kInfinity};
  const double a = -origin / direction, b = (cells - origin) / direction;
  return {std::max(0.0, std::min(a, b)), std::max(a, b)};
}

}  // namespace ray_walk

/// cast_ray on anything that has cells: `stops(column, row)` tells which of them end the ray.
template <class Stops>
double walk_ray(const GridGeometry& g, const Pose2& T_map_ray, double max_range_m, const Stops& stops) {
  using namespace ray_walk;  // NOLINT(google-build-using-namespace)
  const Point2 origin = g.to_cells({T_map_ray.x, T_map_ray.y});
  const double heading = T_map_ray.theta - g.T_map_grid.theta;
  const double dx = std::cos(heading), dy = std::sin(heading);
  const Stretch along_x = within(origin.x, dx, g.width), along_y = within(origin.y, dy, g.height);
  double length = std::max(along_x.begin, along_y.begin);
  const double end = std::min({along_x.end, along_y.end, max_range_m / g.resolution_m});
  if (!(length < end)) return max_range_m;
  Axis x(origin.x, dx, origin.x + length * dx, g.width);
  Axis y(origin.y, dy, origin.y + length * dy, g.height);
  while (length < end) {
    if (stops(x.cell, y.cell)) return length * g.resolution_m;
    Axis& first = x.next < y.next ? x : y;
    length = first.next;
    if (!first.advance()) break;
  }
  return max_range_m;
}

}  // namespace cairn
