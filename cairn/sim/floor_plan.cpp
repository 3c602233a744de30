#include "cairn/sim/floor_plan.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cairn {
namespace {

Rectangle bounds(const std::vector<Segment>& walls) {
  Rectangle box{walls.front().a, walls.front().a};
  for (const Segment& wall : walls) {
    for (const Point2& p : {wall.a, wall.b}) {
      box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y)};
      box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y)};
    }
  }
  return box;
}

GridGeometry geometry_around(const Rectangle& box, double resolution_m, double margin_m) {
  const auto first = [&](double low) { return std::floor((low - margin_m) / resolution_m); };
  const auto cells = [&](double low, double high) {
    return static_cast<int>(std::ceil((high + margin_m) / resolution_m) - first(low)) + 1;
  };
  // Half a cell aside, so that multiples of the resolution lie at cell centres.
  const Pose2 T_map_grid{(first(box.min.x) - 0.5) * resolution_m, (first(box.min.y) - 0.5) * resolution_m,
                         0.0};
  return {cells(box.min.x, box.max.x), cells(box.min.y, box.max.y), resolution_m, T_map_grid};
}

using Cells = std::vector<OccupancyGrid::Cell>;

void draw(const Segment& wall, const GridGeometry& grid, Cells& cells) {
  constexpr double kStepsPerCell = 4.0;
  const double length = std::hypot(wall.b.x - wall.a.x, wall.b.y - wall.a.y);
  const int steps = static_cast<int>(std::ceil(kStepsPerCell * length / grid.resolution_m));
  for (int i = 0; i <= steps; ++i) {
    const double s = steps == 0 ? 0.0 : static_cast<double>(i) / steps;
    const Point2 p = grid.to_cells({std::lerp(wall.a.x, wall.b.x, s), std::lerp(wall.a.y, wall.b.y, s)});
    cells[grid.index(static_cast<int>(p.x), static_cast<int>(p.y))] = 100;
  }
}

// Four-connected, so that it does not slip through a slanting line of cells.
void flood_free(std::pair<int, int> start, const GridGeometry& grid, Cells& cells) {
  std::vector<std::pair<int, int>> open{start};
  while (!open.empty()) {
    const auto [column, row] = open.back();
    open.pop_back();
    if (!grid.contains(column, row)) {
      throw ConfigurationError("floor plan", "the walls do not enclose the point inside", "close them");
    }
    OccupancyGrid::Cell& cell = cells[grid.index(column, row)];
    if (cell != OccupancyGrid::kUnknown) continue;
    cell = 0;
    open.insert(open.end(), {{column + 1, row}, {column - 1, row}, {column, row + 1}, {column, row - 1}});
  }
}

}  // namespace

void add_outline(const Rectangle& r, std::vector<Segment>& walls) {
  const Point2 right_bottom{r.max.x, r.min.y};
  const Point2 left_top{r.min.x, r.max.y};
  walls.insert(walls.end(),
               {{r.min, right_bottom}, {right_bottom, r.max}, {r.max, left_top}, {left_top, r.min}});
}

double distance(const Point2& point, const Segment& segment) {
  const double ex = segment.b.x - segment.a.x;
  const double ey = segment.b.y - segment.a.y;
  const double squared_length = ex * ex + ey * ey;
  const double along = (point.x - segment.a.x) * ex + (point.y - segment.a.y) * ey;
  const double s = squared_length > 0.0 ? std::clamp(along / squared_length, 0.0, 1.0) : 0.0;
  return std::hypot(point.x - segment.a.x - s * ex, point.y - segment.a.y - s * ey);
}

OccupancyGrid rasterize(const FloorPlan& plan, const Point2& inside, double resolution_m, double margin_m) {
  if (plan.walls.empty()) throw ConfigurationError("floor plan", "has no walls", "add some");
  const GridGeometry grid = geometry_around(bounds(plan.walls), resolution_m, margin_m);
  Cells cells(grid.size(), OccupancyGrid::kUnknown);
  for (const Segment& wall : plan.walls) draw(wall, grid, cells);
  const Point2 p = grid.to_cells(inside);
  const std::pair start{static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y))};
  if (grid.contains(start.first, start.second) && cells[grid.index(start.first, start.second)] == 100) {
    throw ConfigurationError("floor plan", "the point inside lies in a wall", "move it");
  }
  flood_free(start, grid, cells);
  return {grid, std::move(cells)};
}

}  // namespace cairn
