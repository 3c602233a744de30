#include "cairn/maps/wall_drawing.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace cairn {
namespace {

constexpr double kMaxCells = 1 << 30;
constexpr OccupancyGrid::Cell kOccupied = 100, kFree = 0;

GridGeometry geometry_for(const Bounds2& bounds, const WallDrawingOptions& o) {
  if (!(o.resolution_m > 0.0 && o.margin_m >= 0.0)) {
    throw ConfigurationError("resolution", "is not positive", "give metres per cell");
  }
  const auto cells_below = [&](double v) { return std::floor((v - o.margin_m) / o.resolution_m) - 1.0; };
  const auto cells_above = [&](double v) { return std::ceil((v + o.margin_m) / o.resolution_m) + 1.0; };
  const double left = cells_below(bounds.min.x), bottom = cells_below(bounds.min.y);
  const double width = cells_above(bounds.max.x) - left + 1.0,
               height = cells_above(bounds.max.y) - bottom + 1.0;
  if (!(width * height <= kMaxCells)) {
    throw ConfigurationError("resolution", "makes a grid of more than 2^30 cells", "give a larger one");
  }
  return {static_cast<int>(width),
          static_cast<int>(height),
          o.resolution_m,
          {(left - 0.5) * o.resolution_m, (bottom - 0.5) * o.resolution_m, 0.0}};
}

void draw(const Wall& wall, const GridGeometry& grid, std::vector<OccupancyGrid::Cell>& cells) {
  const Point2 a = grid.to_cells(wall.a), b = grid.to_cells(wall.b);
  const int steps = static_cast<int>(std::ceil(std::max(std::abs(b.x - a.x), std::abs(b.y - a.y))));
  for (int i = 0; i <= steps; ++i) {
    const double t = steps == 0 ? 0.0 : static_cast<double>(i) / steps;
    const int column = static_cast<int>(a.x + t * (b.x - a.x)), row = static_cast<int>(a.y + t * (b.y - a.y));
    cells[grid.index(column, row)] = kOccupied;
  }
}

// Gives `mark` to all cells that are unknown and can be reached from this one by steps sideways.
void fill(const GridGeometry& grid, std::size_t from, OccupancyGrid::Cell mark,
          std::vector<OccupancyGrid::Cell>& cells) {
  const auto width = static_cast<std::size_t>(grid.width);
  std::vector<std::size_t> left;
  const auto reach = [&](std::size_t i) {
    if (cells[i] != OccupancyGrid::kUnknown) return;
    cells[i] = mark;
    left.push_back(i);
  };
  reach(from);
  while (!left.empty()) {
    const std::size_t i = left.back();
    left.pop_back();
    if (i % width > 0) reach(i - 1);
    if (i % width + 1 < width) reach(i + 1);
    if (i >= width) reach(i - width);
    if (i + width < cells.size()) reach(i + width);
  }
}

std::size_t cell_inside(const Point2& p, const GridGeometry& grid,
                        const std::vector<OccupancyGrid::Cell>& cells) {
  const Point2 cell = grid.to_cells(p);
  const bool on_grid = cell.x >= 0.0 && cell.y >= 0.0 && cell.x < grid.width && cell.y < grid.height;
  const std::size_t i = on_grid ? grid.index(static_cast<int>(cell.x), static_cast<int>(cell.y)) : 0;
  if (!on_grid || cells[i] == kOccupied) {
    throw ConfigurationError("inside point " + std::to_string(p.x) + "," + std::to_string(p.y),
                             on_grid ? "lies in a wall" : "lies off the map", "give a point in free space");
  }
  return i;
}

// Everything that is neither wall nor outside.
void fill_enclosed(const GridGeometry& grid, std::vector<OccupancyGrid::Cell>& cells) {
  constexpr OccupancyGrid::Cell kOutside = 50;
  fill(grid, 0, kOutside, cells);  // the margin is connected and holds no wall
  for (OccupancyGrid::Cell& cell : cells) {
    cell = cell == kOutside ? OccupancyGrid::kUnknown : (cell == kOccupied ? kOccupied : kFree);
  }
}

}  // namespace

OccupancyGrid draw_walls(const VectorMap& map, const WallDrawingOptions& options) {
  const GridGeometry grid = geometry_for(map.bounds(), options);
  std::vector<OccupancyGrid::Cell> cells(grid.size(), OccupancyGrid::kUnknown);
  for (const Wall& wall : map.walls()) {
    if (options.seen.contains(wall.material)) draw(wall, grid, cells);
  }
  if (options.inside.empty()) {
    fill_enclosed(grid, cells);
  } else {
    std::vector<std::size_t> starts;
    for (const Point2& p : options.inside) starts.push_back(cell_inside(p, grid, cells));
    for (const std::size_t start : starts) fill(grid, start, kFree, cells);
  }
  return {grid, std::move(cells)};
}

}  // namespace cairn
