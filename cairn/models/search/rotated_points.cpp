#include "cairn/models/search/rotated_points.hpp"

#include "cairn/core/angle.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

std::int16_t nearest_cell(double offset) { return static_cast<std::int16_t>(std::floor(offset + 0.5)); }

}  // namespace

RotatedPoints::RotatedPoints(std::span<const Point2> points, int headings, int levels)
    : points_(points.size()), headings_(headings), step_rad_(kTwoPi / headings) {
  levels_.resize(static_cast<std::size_t>(levels));
  turn(points);
  for (std::size_t level = 1; level < levels_.size(); ++level) join(level);
}

void RotatedPoints::turn(std::span<const Point2> points) {
  std::vector<Reach>& level = levels_.front();
  level.reserve(points.size() * static_cast<std::size_t>(headings_));
  for (int heading = 0; heading < headings_; ++heading) {
    const double c = std::cos(heading * step_rad_), s = std::sin(heading * step_rad_);
    for (const Point2& p : points) {
      level.push_back({nearest_cell(c * p.x - s * p.y), nearest_cell(s * p.x + c * p.y), 1});
    }
  }
}

void RotatedPoints::join(std::size_t level) {
  const std::vector<Reach>& below = levels_[level - 1];
  std::vector<Reach>& joined = levels_[level];
  joined.reserve(below.size() / 2);
  for (std::size_t first = 0; first + points_ < below.size(); first += 2 * points_) {
    for (std::size_t k = first; k < first + points_; ++k) {
      const Reach& a = below[k];
      const Reach& b = below[k + points_];
      const int column = std::min(a.column, b.column), row = std::min(a.row, b.row);
      const int columns = std::max(a.column + a.side, b.column + b.side) - column;
      const int rows = std::max(a.row + a.side, b.row + b.side) - row;
      joined.push_back({static_cast<std::int16_t>(column), static_cast<std::int16_t>(row),
                        static_cast<std::int16_t>(std::max(columns, rows))});
    }
  }
}

}  // namespace cairn
