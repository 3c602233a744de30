#include "cairn/sim/route_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

namespace cairn {
namespace {

constexpr double kFurthest_m = 5.0;
constexpr std::size_t kNowhere = std::numeric_limits<std::size_t>::max();

struct Open {
  double estimate;  // of the whole way through this cell
  std::size_t cell;
  // Ties are broken by the cell's number: the same way on every machine.
  bool operator>(const Open& o) const {
    return estimate != o.estimate ? estimate > o.estimate : cell > o.cell;
  }
};

using Queue = std::priority_queue<Open, std::vector<Open>, std::greater<>>;

}  // namespace

RoutePlanner::RoutePlanner(const OccupancyGrid& grid, double clearance_m)
    : geometry_(grid.geometry()), open_(grid.geometry().size(), false) {
  const DistanceField field(grid, kFurthest_m);
  for (int row = 0; row < geometry_.height; ++row) {
    for (int column = 0; column < geometry_.width; ++column) {
      const std::size_t cell = geometry_.index(column, row);
      if (grid.state(cell) != CellState::kFree || field.distance_m(cell) < clearance_m) continue;
      open_[cell] = true;
      free_points_.push_back(geometry_.center(column, row));
    }
  }
  label_parts();
}

template <class Visit>
void RoutePlanner::for_each_neighbour(std::size_t cell, const Visit& visit) const {
  const auto width = static_cast<std::size_t>(geometry_.width);
  const int column = static_cast<int>(cell % width), row = static_cast<int>(cell / width);
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if ((dx == 0 && dy == 0) || !is_open(column + dx, row + dy)) continue;
      visit(geometry_.index(column + dx, row + dy), dx != 0 && dy != 0);
    }
  }
}

// Flood fill: what can be reached from one another gets one number.
void RoutePlanner::label_parts() {
  part_.assign(open_.size(), 0);
  std::uint32_t parts = 0;
  std::vector<std::size_t> to_visit;
  for (std::size_t first = 0; first < open_.size(); ++first) {
    if (!open_[first] || part_[first] != 0) continue;
    part_[first] = ++parts;
    to_visit.push_back(first);
    while (!to_visit.empty()) {
      const std::size_t cell = to_visit.back();
      to_visit.pop_back();
      for_each_neighbour(cell, [&](std::size_t next, bool) {
        if (part_[next] != 0) return;
        part_[next] = parts;
        to_visit.push_back(next);
      });
    }
  }
}

bool RoutePlanner::joins(const Point2& a, const Point2& b) const {
  const auto start = cell_of(a), goal = cell_of(b);
  return start && goal && part_[*start] == part_[*goal];
}

bool RoutePlanner::is_open(int column, int row) const {
  return geometry_.contains(column, row) && open_[geometry_.index(column, row)];
}

std::optional<std::size_t> RoutePlanner::cell_of(const Point2& point) const {
  const Point2 p = geometry_.to_cells(point);
  const int column = static_cast<int>(std::floor(p.x)), row = static_cast<int>(std::floor(p.y));
  if (!is_open(column, row)) return std::nullopt;
  return geometry_.index(column, row);
}

bool RoutePlanner::is_free(const Point2& point) const { return cell_of(point).has_value(); }

bool RoutePlanner::sees(const Point2& a, const Point2& b) const {
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  const int steps = 1 + static_cast<int>(2.0 * length / geometry_.resolution_m);
  for (int i = 0; i <= steps; ++i) {
    const double s = static_cast<double>(i) / steps;
    if (!is_free({std::lerp(a.x, b.x, s), std::lerp(a.y, b.y, s)})) return false;
  }
  return true;
}

std::optional<std::vector<Point2>> RoutePlanner::route(const Point2& from, const Point2& to) const {
  if (!joins(from, to)) return std::nullopt;
  const auto start = cell_of(from), goal = cell_of(to);
  if (sees(from, to)) return std::vector<Point2>{to};
  const auto width = static_cast<std::size_t>(geometry_.width);
  const auto guess = [&](std::size_t cell) {
    const std::size_t column = cell % width, row = cell / width;
    const std::size_t goal_column = *goal % width, goal_row = *goal / width;
    return std::hypot(static_cast<double>(column) - static_cast<double>(goal_column),
                      static_cast<double>(row) - static_cast<double>(goal_row));
  };
  std::vector<double> cost(open_.size(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> came_from(open_.size(), kNowhere);
  Queue queue;
  cost[*start] = 0.0;
  queue.push({guess(*start), *start});
  while (!queue.empty() && queue.top().cell != *goal) {
    const auto [estimate, cell] = queue.top();
    queue.pop();
    if (estimate > cost[cell] + guess(cell)) continue;  // reached on a shorter way since
    for_each_neighbour(cell, [&, from = cell](std::size_t next, bool diagonal) {
      const double reached = cost[from] + (diagonal ? std::numbers::sqrt2 : 1.0);
      if (reached >= cost[next]) return;
      cost[next] = reached;
      came_from[next] = from;
      queue.push({reached + guess(next), next});
    });
  }
  std::vector<Point2> way = trace(*goal, came_from);
  way.back() = to;
  return cut_corners(from, std::move(way));
}

std::vector<Point2> RoutePlanner::trace(std::size_t goal, const std::vector<std::size_t>& from) const {
  const auto width = static_cast<std::size_t>(geometry_.width);
  std::vector<Point2> way;
  for (std::size_t cell = goal; from[cell] != kNowhere; cell = from[cell]) {
    way.push_back(geometry_.center(static_cast<int>(cell % width), static_cast<int>(cell / width)));
  }
  std::reverse(way.begin(), way.end());
  return way;
}

std::vector<Point2> RoutePlanner::cut_corners(const Point2& from, std::vector<Point2> way) const {
  std::vector<Point2> corners;
  Point2 at = from;
  for (std::size_t next = 0; next < way.size(); ++next) {
    // The last cell that is seen from here before one that is not.
    std::size_t last = next;
    while (last + 1 < way.size() && sees(at, way[last + 1])) ++last;
    corners.push_back(way[last]);
    at = way[last];
    next = last;
  }
  return corners;
}

}  // namespace cairn
