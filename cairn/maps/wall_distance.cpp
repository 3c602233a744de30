#include "cairn/maps/wall_distance.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn {
namespace {

constexpr double kMaxCells = 4e6;

Point2 nearest_on(const Wall& wall, const Point2& p) {
  const double dx = wall.b.x - wall.a.x, dy = wall.b.y - wall.a.y;
  const double along = ((p.x - wall.a.x) * dx + (p.y - wall.a.y) * dy) / (dx * dx + dy * dy);
  const double t = std::clamp(along, 0.0, 1.0);
  return {wall.a.x + t * dx, wall.a.y + t * dy};
}

double squared_distance(const Point2& a, const Point2& b) {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

}  // namespace

WallDistance::WallDistance(std::shared_ptr<const VectorMap> map, double max_distance_m, MaterialSet seen,
                           double cell_m)
    : map_(std::move(map)), max_distance_m_(max_distance_m) {
  if (!(max_distance_m > 0.0 && max_distance_m <= VectorMap::kMaxCoordinate_m)) {
    throw ConfigurationError("largest distance to a wall", "is not positive", "give metres");
  }
  choose_cells(cell_m);
  const std::size_t cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  const std::vector<Wall>& walls = map_->walls();
  std::vector<double> smallest(cells, std::numeric_limits<double>::infinity());
  const auto for_each_pair = [&](const auto& visit) {
    for (std::uint32_t i = 0; i < walls.size(); ++i) {
      if (!seen.contains(walls[i].material)) continue;
      for_each_near(walls[i], [&](std::size_t cell, double d) { visit(i, cell, d); });
    }
  };
  for_each_pair(
      [&](std::uint32_t, std::size_t cell, double d) { smallest[cell] = std::min(smallest[cell], d); });
  const double diagonal = std::sqrt(2.0) * cell_m_ * (1.0 + 1e-9);
  first_.assign(cells + 1, 0);
  for_each_pair([&](std::uint32_t, std::size_t cell, double d) {
    if (d <= smallest[cell] + diagonal) ++first_[cell + 1];
  });
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  candidates_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for_each_pair([&](std::uint32_t wall, std::size_t cell, double d) {
    if (d <= smallest[cell] + diagonal) candidates_[next[cell]++] = wall;
  });
}

void WallDistance::choose_cells(double cell_m) {
  const Bounds2& b = map_->bounds();
  const double width = b.max.x - b.min.x + 2.0 * max_distance_m_;
  const double height = b.max.y - b.min.y + 2.0 * max_distance_m_;
  cell_m_ = std::max({cell_m, std::sqrt(4.0 * width * height / kMaxCells), 4.0 * width / kMaxCells,
                      4.0 * height / kMaxCells});
  origin_ = {b.min.x - max_distance_m_, b.min.y - max_distance_m_};
  columns_ = static_cast<int>(width / cell_m_) + 1;
  rows_ = static_cast<int>(height / cell_m_) + 1;
}

// The cells that have points within the largest distance of the wall, row by row, with the distance of their
// centres.
template <class Visit>
void WallDistance::for_each_near(const Wall& wall, const Visit& visit) const {
  const double reach = max_distance_m_ + cell_m_;  // half a diagonal is less than a cell
  const auto index = [&](double offset, int count) {
    return static_cast<int>(std::clamp(std::floor(offset / cell_m_), 0.0, count - 1.0));
  };
  const double dx = wall.b.x - wall.a.x, dy = wall.b.y - wall.a.y;
  const int top = index(std::max(wall.a.y, wall.b.y) + reach - origin_.y, rows_);
  for (int row = index(std::min(wall.a.y, wall.b.y) - reach - origin_.y, rows_); row <= top; ++row) {
    // The part of the wall that is near this row, then as far to both sides.
    const double y0 = origin_.y + row * cell_m_ - reach, y1 = y0 + cell_m_ + 2.0 * reach;
    const double t0 = dy == 0.0 ? 0.0 : std::clamp((y0 - wall.a.y) / dy, 0.0, 1.0);
    const double t1 = dy == 0.0 ? 1.0 : std::clamp((y1 - wall.a.y) / dy, 0.0, 1.0);
    const double x0 = wall.a.x + t0 * dx, x1 = wall.a.x + t1 * dx;
    const int last = index(std::max(x0, x1) + reach - origin_.x, columns_);
    for (int column = index(std::min(x0, x1) - reach - origin_.x, columns_); column <= last; ++column) {
      const Point2 center{origin_.x + (column + 0.5) * cell_m_, origin_.y + (row + 0.5) * cell_m_};
      const double d = distance(center, wall);
      const std::size_t cell = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                               static_cast<std::size_t>(column);
      if (d <= reach) visit(cell, d);
    }
  }
}

std::optional<Point2> WallDistance::nearest(const Point2& point) const {
  const double column = (point.x - origin_.x) / cell_m_, row = (point.y - origin_.y) / cell_m_;
  if (!(column >= 0.0 && row >= 0.0 && column < columns_ && row < rows_)) return std::nullopt;
  const std::size_t cell =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  double best = max_distance_m_ * max_distance_m_;
  std::optional<Point2> found;
  for (std::uint32_t i = first_[cell]; i < first_[cell + 1]; ++i) {
    const Point2 on_wall = nearest_on(map_->walls()[candidates_[i]], point);
    const double d = squared_distance(on_wall, point);
    if (d > best) continue;
    best = d;
    found = on_wall;
  }
  return found;
}

}  // namespace cairn
