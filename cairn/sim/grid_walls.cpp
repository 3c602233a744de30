#include "cairn/sim/grid_walls.hpp"

#include <cmath>

namespace cairn {
namespace {

class EdgeCollector {
 public:
  explicit EdgeCollector(const OccupancyGrid& grid) : grid_(grid), geometry_(grid.geometry()) {}

  std::vector<Wall> collect() {
    // Lines between rows, then lines between columns: `along` runs, `across` numbers the lines.
    for (int across = 0; across <= geometry_.height; ++across) {
      walk(
          geometry_.width, [&](int along) { return occupied(along, across) != occupied(along, across - 1); },
          [&](int along) { return point(along, across); });
    }
    for (int across = 0; across <= geometry_.width; ++across) {
      walk(
          geometry_.height, [&](int along) { return occupied(across, along) != occupied(across - 1, along); },
          [&](int along) { return point(across, along); });
    }
    return std::move(walls_);
  }

 private:
  bool occupied(int column, int row) const {
    return geometry_.contains(column, row) &&
           grid_.state(geometry_.index(column, row)) == CellState::kOccupied;
  }

  Point2 point(int column, int row) const {
    return geometry_.T_map_grid * Point2{column * geometry_.resolution_m, row * geometry_.resolution_m};
  }

  template <typename IsEdge, typename At>
  void walk(int count, IsEdge is_edge, At at) {
    for (int begin = 0; begin < count; ++begin) {
      if (!is_edge(begin)) continue;
      int end = begin + 1;
      while (end < count && is_edge(end)) ++end;
      walls_.push_back({at(begin), at(end), Material::kOpaque});
      begin = end;
    }
  }

  const OccupancyGrid& grid_;
  GridGeometry geometry_;
  std::vector<Wall> walls_;
};

}  // namespace

std::vector<Wall> walls_of_grid(const OccupancyGrid& grid) { return EdgeCollector(grid).collect(); }

OccupancyGrid cleared_along(const OccupancyGrid& grid, const Trajectory& path, double clear_m) {
  const GridGeometry& g = grid.geometry();
  const double reach = clear_m / g.resolution_m;
  std::vector<OccupancyGrid::Cell> cells = grid.cells();
  for (const StampedPose& p : path) {
    const Point2 at = g.to_cells({p.pose.x, p.pose.y});
    for (int row = static_cast<int>(std::floor(at.y - reach)); row <= at.y + reach; ++row) {
      for (int column = static_cast<int>(std::floor(at.x - reach)); column <= at.x + reach; ++column) {
        const bool near = std::hypot(column + 0.5 - at.x, row + 0.5 - at.y) < reach;
        if (near && g.contains(column, row)) cells[g.index(column, row)] = 0;
      }
    }
  }
  return {g, std::move(cells), grid.thresholds()};
}

}  // namespace cairn
