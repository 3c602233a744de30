#include "cairn/maps/ray_casting.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Shortens `hit` to this wall if the ray meets it there. A ray passes between the ends of a wall if they lie
// on different sides of it; a shared end point lies on the same side for both of its walls, to the bit.
inline void meet(const Point2& o, const Point2& u, const Point2& a, const Point2& b, std::uint32_t wall,
                 RayHit& hit) {
  const double ax = a.x - o.x, ay = a.y - o.y, bx = b.x - o.x, by = b.y - o.y;
  const double side_a = u.x * ay - u.y * ax, side_b = u.x * by - u.y * bx;
  if ((side_a > 0.0 && side_b > 0.0) || (side_a < 0.0 && side_b < 0.0)) return;
  const double along_a = u.x * ax + u.y * ay, along_b = u.x * bx + u.y * by;
  const double range = along_a + side_a / (side_a - side_b) * (along_b - along_a);
  if (range >= 0.0 && range <= hit.range_m) hit = {range, wall};  // false for NaN: seen edge-on
}

// The part of the ray, in metres from its origin, within [low, high] of one axis.
inline void clip(double from, double direction, double low, double high, double& enter, double& leave) {
  if (direction == 0.0) {
    if (from < low || from > high) leave = -kInfinity;
    return;
  }
  const double t0 = (low - from) / direction, t1 = (high - from) / direction;
  enter = std::max(enter, std::min(t0, t1));
  leave = std::min(leave, std::max(t0, t1));
}

// One axis of the walk through the cells.
struct ExactAxis {
  ExactAxis(double from, double direction, double origin, double cell_m, int count, double enter) {
    const double at = (from + enter * direction - origin) / cell_m;
    index = static_cast<int>(std::clamp(at, 0.0, count - 1.0));
    step = direction > 0.0 ? 1 : -1;
    end = direction > 0.0 ? count : -1;
    next = direction == 0.0 ? kInfinity
                            : (origin + (index + (direction > 0.0 ? 1 : 0)) * cell_m - from) / direction;
    per_cell = direction == 0.0 ? kInfinity : cell_m / std::abs(direction);
  }
  int index, step, end;
  double next;      ///< range at which the ray leaves the cell
  double per_cell;  ///< range per cell
};

}  // namespace

RayHit cast_ray(const WallGrid& grid, const Point2& o, const Point2& u, double max_range_m) {
  RayHit best{max_range_m, kNoWall};
  double enter = 0.0, leave = max_range_m;
  const Point2& corner = grid.origin();
  clip(o.x, u.x, corner.x, corner.x + grid.columns() * grid.cell_m(), enter, leave);
  clip(o.y, u.y, corner.y, corner.y + grid.rows() * grid.cell_m(), enter, leave);
  if (!(enter <= leave) || !std::isfinite(o.x + o.y + u.x + u.y + enter)) return {};
  ExactAxis x(o.x, u.x, corner.x, grid.cell_m(), grid.columns(), enter);
  ExactAxis y(o.y, u.y, corner.y, grid.cell_m(), grid.rows(), enter);
  for (;;) {
    for (const WallInCell& w : grid.cell(x.index, y.index)) meet(o, u, w.a, w.b, w.wall, best);
    ExactAxis& axis = x.next < y.next ? x : y;
    if (best.range_m <= axis.next) break;
    axis.index += axis.step;
    if (axis.index == axis.end) break;
    axis.next += axis.per_cell;
  }
  return best ? best : RayHit{};
}

RayHit cast_ray_by_brute_force(const VectorMap& map, MaterialSet seen, const Point2& origin,
                               const Point2& direction, double max_range_m) {
  RayHit best{max_range_m, kNoWall};
  for (std::uint32_t i = 0; i < map.walls().size(); ++i) {
    const Wall& wall = map.walls()[i];
    if (seen.contains(wall.material)) meet(origin, direction, wall.a, wall.b, i, best);
  }
  return best ? best : RayHit{};
}

}  // namespace cairn
