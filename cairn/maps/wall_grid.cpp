#include "cairn/maps/wall_grid.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kMaxCells = 4e6;
// Half the width of the corridor around a wall whose cells list it; far from the origin as wide as rounding.
constexpr double kSlack_m = 1e-9;
constexpr double kSlackShare = 1e-14;
// A wall of length l touches about 4 l / (pi cell) + 1 cells.
constexpr double kCellsPerLength = 4.0 / 3.141592653589793;
constexpr double kEntriesPerWall = 6.0;
constexpr double kFreeEntries = 1e5;

}  // namespace

WallGrid::WallGrid(std::shared_ptr<const VectorMap> map, MaterialSet seen_materials, double cell_m)
    : map_(std::move(map)) {
  std::vector<std::uint32_t> seen;
  for (std::uint32_t i = 0; i < map_->walls().size(); ++i) {
    if (seen_materials.contains(map_->walls()[i].material)) seen.push_back(i);
  }
  choose_cells(seen, cell_m);
  fill(seen);
}

void WallGrid::choose_cells(const std::vector<std::uint32_t>& seen, double cell_m) {
  const Bounds2& b = map_->bounds();
  const double scale = std::max({std::abs(b.min.x), std::abs(b.min.y), std::abs(b.max.x), std::abs(b.max.y)});
  slack_m_ = kSlack_m + kSlackShare * scale;
  const double width = b.max.x - b.min.x + 4.0 * slack_m_, height = b.max.y - b.min.y + 4.0 * slack_m_;
  double length = 0.0;
  for (const std::uint32_t i : seen) {
    const Wall& w = map_->walls()[i];
    length += std::hypot(w.b.x - w.a.x, w.b.y - w.a.y);
  }
  const double walls = std::max(1.0, static_cast<double>(seen.size()));
  const double wanted = cell_m > 0.0 ? cell_m : 0.6 * std::sqrt(width * height / walls);
  const double few_entries = kCellsPerLength * length / (kEntriesPerWall * walls + kFreeEntries);
  // The margin of 1 cell each way makes (w/c + 1)(h/c + 1) cells: bounded term by term.
  const double few_cells = std::max(
      {std::sqrt(4.0 * width * height / kMaxCells), 4.0 * width / kMaxCells, 4.0 * height / kMaxCells, 1e-3});
  cell_m_ = std::max({wanted, few_entries, few_cells});
  origin_ = {b.min.x - 2.0 * slack_m_, b.min.y - 2.0 * slack_m_};
  columns_ = static_cast<int>(width / cell_m_) + 1;
  rows_ = static_cast<int>(height / cell_m_) + 1;
}

// Column by column, the rows between which the wall runs there.
template <class Visit>
void WallGrid::for_each_cell(const Wall& wall, const Visit& visit) const {
  const Point2& l = wall.a.x <= wall.b.x ? wall.a : wall.b;
  const Point2& r = wall.a.x <= wall.b.x ? wall.b : wall.a;
  const auto index = [&](double offset, int count) {
    return std::clamp(static_cast<int>(offset / cell_m_), 0, count - 1);
  };
  const int first = index(l.x - slack_m_ - origin_.x, columns_);
  const int last = index(r.x + slack_m_ - origin_.x, columns_);
  const double slope = r.x > l.x ? (r.y - l.y) / (r.x - l.x) : 0.0;
  const double low = std::min(l.y, r.y), high = std::max(l.y, r.y);
  for (int column = first; column <= last; ++column) {
    double y0 = low, y1 = high;
    if (r.x - l.x > 1e-6 * (high - low)) {  // else too steep to tell columns apart
      const double x0 = origin_.x + column * cell_m_ - slack_m_, x1 = x0 + cell_m_ + 2.0 * slack_m_;
      const double at0 = l.y + slope * (x0 - l.x), at1 = l.y + slope * (x1 - l.x);
      y0 = std::clamp(std::min(at0, at1), low, high);
      y1 = std::clamp(std::max(at0, at1), low, high);
    }
    const int top = index(y1 + slack_m_ - origin_.y, rows_);
    for (int row = index(y0 - slack_m_ - origin_.y, rows_); row <= top; ++row) visit(column, row);
  }
}

void WallGrid::fill(const std::vector<std::uint32_t>& seen) {
  const auto columns = static_cast<std::size_t>(columns_);
  first_.assign(columns * static_cast<std::size_t>(rows_) + 1, 0);
  const auto index = [&](int column, int row) {
    return static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column);
  };
  for (const std::uint32_t i : seen) {
    for_each_cell(map_->walls()[i], [&](int column, int row) { ++first_[index(column, row) + 1]; });
  }
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  entries_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (const std::uint32_t i : seen) {
    const Wall& wall = map_->walls()[i];
    for_each_cell(wall, [&](int column, int row) {
      entries_[next[index(column, row)]++] = {wall.a, wall.b, i};
    });
  }
}

}  // namespace cairn
