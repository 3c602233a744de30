#include "cairn/maps/wall_extraction.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace cairn {
namespace {

constexpr int kDirectionRadius = 3;      // cells around a cell that tell the direction of the border
constexpr int kGrowthRadius = 2;         // a wall grows over gaps of one cell
constexpr double kStraight = 0.8;        // straightness that makes larger surroundings do
constexpr double kClearDirection = 0.5;  // straightness from which on a cell's direction counts

// Sums over points, for a straight line by total least squares.
struct LineFit {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;

  void add(const Point2& p) { n += 1, x += p.x, y += p.y, xx += p.x * p.x, xy += p.x * p.y, yy += p.y * p.y; }
  Point2 center() const { return {x / n, y / n}; }
  double angle() const { return 0.5 * std::atan2(2.0 * c_xy(), c_xx() - c_yy()); }
  /// 0: round, 1: straight.
  double straightness() const {
    const double sum = c_xx() + c_yy();
    return sum > 0.0 ? std::hypot(c_xx() - c_yy(), 2.0 * c_xy()) / sum : 0.0;
  }

 private:
  double c_xx() const { return xx - x * x / n; }
  double c_xy() const { return xy - x * y / n; }
  double c_yy() const { return yy - y * y / n; }
};

struct BorderPoint {
  int column, row;
  double angle, straightness;
  bool used = false;
  Point2 center() const { return {column + 0.5, row + 0.5}; }
};

double angle_between_lines(double a, double b) { return std::abs(std::remainder(a - b, 3.141592653589793)); }

class WallExtraction {
 public:
  WallExtraction(const OccupancyGrid& grid, const WallExtractionOptions& options)
      : grid_(grid),
        options_(options),
        at_(grid.geometry().size(), kNone),
        asked_(grid.geometry().size(), 0) {}

  std::vector<Wall> walls() {
    find_border();
    find_directions();
    std::vector<std::uint32_t> order(points_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return points_[a].straightness > points_[b].straightness;
    });
    for (const std::uint32_t seed : order) {
      if (!points_[seed].used) grow(seed);
    }
    return std::move(walls_);
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  template <class Visit>
  void for_each_around(int column, int row, int radius, const Visit& visit) const {
    const GridGeometry& g = grid_.geometry();
    for (int r = std::max(0, row - radius); r <= std::min(g.height - 1, row + radius); ++r) {
      for (int c = std::max(0, column - radius); c <= std::min(g.width - 1, column + radius); ++c) {
        visit(g.index(c, r));
      }
    }
  }

  bool is_border(int column, int row) const {
    const std::size_t i = grid_.geometry().index(column, row);
    if (grid_.state(i) != CellState::kOccupied) return false;
    bool beside_free = false;
    for_each_around(column, row, 1,
                    [&](std::size_t j) { beside_free |= grid_.state(j) == CellState::kFree; });
    return beside_free;
  }

  void find_border() {
    const GridGeometry& g = grid_.geometry();
    for (int row = 0; row < g.height; ++row) {
      for (int column = 0; column < g.width; ++column) {
        if (!is_border(column, row)) continue;
        at_[g.index(column, row)] = static_cast<std::uint32_t>(points_.size());
        points_.push_back({column, row, 0.0, 0.0});
      }
    }
  }

  // From the largest surroundings in which the border is straight.
  void find_directions() {
    for (BorderPoint& p : points_) {
      for (int radius = kDirectionRadius; radius > 0 && p.straightness < kStraight; --radius) {
        const LineFit fit = border_around(p, radius);
        if (fit.straightness() <= p.straightness) continue;
        p.angle = fit.angle();
        p.straightness = fit.straightness();
      }
    }
  }

  LineFit border_around(const BorderPoint& p, int radius) const {
    LineFit fit;
    for_each_around(p.column, p.row, radius, [&](std::size_t i) {
      // Relative to the point: small numbers, and the same result wherever it lies.
      if (at_[i] == kNone) return;
      const BorderPoint& q = points_[at_[i]];
      fit.add({static_cast<double>(q.column - p.column), static_cast<double>(q.row - p.row)});
    });
    return fit;
  }

  bool fits(const BorderPoint& p, const Point2& through, double angle) const {
    const Point2 c = p.center();
    const double off = std::abs(-std::sin(angle) * (c.x - through.x) + std::cos(angle) * (c.y - through.y));
    if (p.used) return off <= options_.tolerance_cells;
    return off <= options_.tolerance_cells && (p.straightness < kClearDirection ||
                                               angle_between_lines(p.angle, angle) <= options_.max_angle_rad);
  }

  void grow(std::uint32_t seed) {
    const Point2 origin = points_[seed].center();
    Point2 through = origin;
    double angle = points_[seed].angle;
    std::vector<std::uint32_t> region{seed}, touched;  // touched: cells of other walls, at corners
    ++pass_;
    asked_[grid_.geometry().index(points_[seed].column, points_[seed].row)] = pass_;
    std::size_t next_fit = 6;
    for (std::size_t i = 0; i < region.size(); ++i) {
      const BorderPoint& p = points_[region[i]];
      for_each_around(p.column, p.row, kGrowthRadius, [&](std::size_t j) {
        if (at_[j] == kNone || asked_[j] == pass_ || !fits(points_[at_[j]], through, angle)) return;
        asked_[j] = pass_;
        (points_[at_[j]].used ? touched : region).push_back(at_[j]);
      });
      if (region.size() < next_fit) continue;
      refit(region, origin, through, angle);
      next_fit = region.size() + region.size() / 2;
    }
    refit(region, origin, through, angle);
    keep(region, touched, through, angle);
  }

  void refit(const std::vector<std::uint32_t>& region, const Point2& origin, Point2& through,
             double& angle) const {
    LineFit fit;
    for (const std::uint32_t i : region) {
      const Point2 c = points_[i].center();
      fit.add({c.x - origin.x, c.y - origin.y});
    }
    if (region.size() < 2) return;
    through = {origin.x + fit.center().x, origin.y + fit.center().y};
    angle = fit.angle();
  }

  void keep(const std::vector<std::uint32_t>& region, const std::vector<std::uint32_t>& touched,
            const Point2& through, double angle) {
    const double dx = std::cos(angle), dy = std::sin(angle);
    double first = 0.0, last = 0.0;
    const auto reach = [&](std::uint32_t i) {
      const Point2 c = points_[i].center();
      const double along = dx * (c.x - through.x) + dy * (c.y - through.y);
      first = std::min(first, along);
      last = std::max(last, along);
    };
    std::for_each(region.begin(), region.end(), reach);
    if (last - first + 1.0 < options_.min_length_cells) return;
    for (const std::uint32_t i : region) points_[i].used = true;
    std::for_each(touched.begin(), touched.end(), reach);
    first -= 0.5, last += 0.5;
    const GridGeometry& g = grid_.geometry();
    const auto to_map = [&](double along) {
      return g.T_map_grid *
             Point2{(through.x + along * dx) * g.resolution_m, (through.y + along * dy) * g.resolution_m};
    };
    walls_.push_back({to_map(first), to_map(last)});
  }

  const OccupancyGrid& grid_;
  const WallExtractionOptions& options_;
  std::vector<std::uint32_t> at_;     ///< per cell, its point
  std::vector<std::uint32_t> asked_;  ///< per cell, the pass that took it
  std::uint32_t pass_ = 0;
  std::vector<BorderPoint> points_;
  std::vector<Wall> walls_;
};

}  // namespace

VectorMap extract_walls(const OccupancyGrid& grid, const WallExtractionOptions& options) {
  std::vector<Wall> walls = WallExtraction(grid, options).walls();
  if (walls.empty()) {
    throw InputError("map", "has no straight wall beside free space",
                     "give a map with free and occupied cells");
  }
  return VectorMap(std::move(walls));
}

}  // namespace cairn
