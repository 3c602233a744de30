#include "cairn/maps/occupancy_grid.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace cairn {

Point2 GridGeometry::center(int column, int row) const {
  return T_map_grid * Point2{(column + 0.5) * resolution_m, (row + 0.5) * resolution_m};
}

Point2 GridGeometry::to_cells(const Point2& p_map) const {
  const Point2 p_grid = inverse(T_map_grid) * p_map;
  return {p_grid.x / resolution_m, p_grid.y / resolution_m};
}

OccupancyGrid::OccupancyGrid(GridGeometry geometry, std::vector<Cell> cells, Thresholds thresholds)
    : geometry_(geometry), cells_(std::move(cells)), thresholds_(thresholds) {
  const auto refuse = [](const std::string& what, const std::string& remedy) {
    throw InputError("occupancy grid", what, remedy);
  };
  if (geometry.width <= 0 || geometry.height <= 0) refuse("has no cells", "give it a width and a height");
  if (!(geometry.resolution_m > 0.0) || !std::isfinite(geometry.resolution_m)) {
    refuse("resolution is not a positive number of metres", "correct it");
  }
  if (!is_finite(geometry.T_map_grid)) refuse("origin is not finite", "correct it");
  if (cells_.size() != geometry.size()) refuse("number of cells does not fit width x height", "correct one");
  if (std::any_of(cells_.begin(), cells_.end(), [](Cell c) { return c < kUnknown || c > 100; })) {
    refuse("a cell is outside -1..100", "scale the cells to percent");
  }
}

CellState OccupancyGrid::state(std::size_t index) const {
  if (cells_[index] == kUnknown) return CellState::kUnknown;
  const double probability = cells_[index] / 100.0;
  if (probability > thresholds_.occupied) return CellState::kOccupied;
  return probability < thresholds_.free ? CellState::kFree : CellState::kUnknown;
}

CellState OccupancyGrid::state_at(const Point2& p_map) const {
  const Point2 p = geometry_.to_cells(p_map);
  if (!(p.x >= 0.0 && p.x < geometry_.width && p.y >= 0.0 && p.y < geometry_.height))
    return CellState::kUnknown;
  return state(geometry_.index(static_cast<int>(p.x), static_cast<int>(p.y)));
}

std::size_t OccupancyGrid::count(CellState wanted) const {
  std::size_t n = 0;
  for (std::size_t i = 0; i < cells_.size(); ++i) n += state(i) == wanted ? 1 : 0;
  return n;
}

}  // namespace cairn
