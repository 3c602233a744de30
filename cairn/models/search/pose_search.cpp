#include "cairn/models/search/pose_search.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/models/search/least_cost_windows.hpp"
#include "cairn/models/search/rotated_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace cairn {
namespace {

constexpr int kLevels = 6;          // boxes of up to 32 cells and headings
constexpr int kLargestWindow = 96;  // a point that reaches farther costs nothing in the bound
constexpr double kFarthest_cells = 16000.0;
constexpr double kSteeringShare = 0.9;  // share of the points that the headings' step must not move by a cell
constexpr std::size_t kFirstLook = 24;  // points of a box's first, rough bound
constexpr int kMostDives = 1000;

double turn_between(const Pose2& a, const Pose2& b) { return std::abs(normalize_angle(a.theta - b.theta)); }

/// What may still hold the best pose: 2^level x 2^level cells from (column, row), 2^level headings.
struct Box {
  std::int32_t column;
  std::int32_t row;
  std::int32_t heading;  // index of the group at its level
  std::uint32_t cost;    // bound, in steps
  std::uint32_t first;   // share of the first points
  std::uint32_t rest;    // share of the others; of the parent while `rough`
  std::uint8_t level;
  bool rough;
};

struct Leaf {
  double cost;
  std::int32_t heading;
  std::int32_t row;
  std::int32_t column;
  bool operator<(const Leaf& other) const {
    return std::tie(cost, heading, row, column) <
           std::tie(other.cost, other.heading, other.row, other.column);
  }
};

CellBox known_cells(const OccupancyGrid& map, const DistanceField& field) {
  const GridGeometry& grid = map.geometry();
  int left = grid.width, right = -1, bottom = grid.height, top = -1;
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      const std::size_t cell = grid.index(column, row);
      const bool near_wall = field.distance_m(cell) < static_cast<float>(field.max_distance_m());
      if (!near_wall && map.state(cell) != CellState::kFree) continue;
      left = std::min(left, column), right = std::max(right, column);
      bottom = std::min(bottom, row), top = std::max(top, row);
    }
  }
  return {left, bottom, std::max(0, right - left + 1), std::max(0, top - bottom + 1)};
}

// Every n-th point, so that the first ones already show all around: stride near the golden section of their
// number, without a common divisor.
std::vector<Point2> spread_order(std::vector<Point2> points) {
  const std::size_t n = points.size();
  auto stride = static_cast<std::size_t>(0.618 * static_cast<double>(n));
  while (stride > 1 && std::gcd(stride, n) != 1) --stride;
  std::vector<Point2> ordered;
  ordered.reserve(n);
  for (std::size_t k = 0; k < n; ++k) ordered.push_back(points[k * std::max<std::size_t>(stride, 1) % n]);
  return ordered;
}

int headings_for(const std::vector<Point2>& points) {
  std::vector<double> ranges;
  ranges.reserve(points.size());
  for (const Point2& p : points) ranges.push_back(std::hypot(p.x, p.y));
  const auto place =
      ranges.begin() + static_cast<std::ptrdiff_t>(kSteeringShare * static_cast<double>(ranges.size() - 1));
  std::nth_element(ranges.begin(), place, ranges.end());
  constexpr int kGroup = 1 << (kLevels - 1);
  const int groups = static_cast<int>(std::ceil(kTwoPi * std::max(*place, 1.0) / kGroup));
  return kGroup * std::max(groups, 2);
}

}  // namespace

struct PoseSearch::Map {
  Map(const OccupancyGrid& map, const LikelihoodFieldOptions& model)
      : Map(map, model, DistanceField(map, model.max_distance_m)) {}
  Map(const OccupancyGrid& map, const LikelihoodFieldOptions& model, const DistanceField& field)
      : box(known_cells(map, field)), windows(field, model, box, kLargestWindow) {
    geometry = map.geometry();
    geometry.T_map_grid = geometry.T_map_grid * Pose2{box.first_column * geometry.resolution_m,
                                                      box.first_row * geometry.resolution_m, 0.0};
    geometry.width = box.columns;
    geometry.height = box.rows;
    free.reserve(geometry.size());
    for (int row = 0; row < box.rows; ++row) {
      for (int column = 0; column < box.columns; ++column) {
        const std::size_t cell = map.geometry().index(box.first_column + column, box.first_row + row);
        free.push_back(map.state(cell) == CellState::kFree);
      }
    }
  }

  std::vector<Point2> in_cells(std::span<const Point2> points) const {
    std::vector<Point2> cells;
    for (const Point2& p : points) {
      const Point2 cell{p.x / geometry.resolution_m, p.y / geometry.resolution_m};
      if (std::hypot(cell.x, cell.y) < kFarthest_cells) cells.push_back(cell);  // false for NaN
    }
    return cells;
  }

  CellBox box;
  LeastCostWindows windows;
  GridGeometry geometry;  ///< of the box
  std::vector<bool> free;
};

namespace {

/// Which boxes of each level hold a cell where the robot may be.
class AllowedBoxes {
 public:
  AllowedBoxes(const GridGeometry& grid, const std::vector<bool>& free,
               const std::optional<MapRegion>& region) {
    levels_.push_back({grid.width, grid.height, std::vector<bool>(grid.size())});
    for (int row = 0; row < grid.height; ++row) {
      for (int column = 0; column < grid.width; ++column) {
        const std::size_t cell = grid.index(column, row);
        levels_[0].any[cell] = free[cell] && (!region || inside(*region, grid.center(column, row)));
      }
    }
    while (levels_.size() < static_cast<std::size_t>(kLevels)) levels_.push_back(halve(levels_.back()));
  }

  bool any(int level, int column, int row) const {
    const Level& l = levels_[static_cast<std::size_t>(level)];
    return column < l.columns && row < l.rows && l.any[l.index(column, row)];
  }
  int columns(int level) const { return levels_[static_cast<std::size_t>(level)].columns; }
  int rows(int level) const { return levels_[static_cast<std::size_t>(level)].rows; }
  std::int64_t cells() const { return std::count(levels_[0].any.begin(), levels_[0].any.end(), true); }

 private:
  struct Level {
    int columns;
    int rows;
    std::vector<bool> any;
    std::size_t index(int column, int row) const {
      return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
             static_cast<std::size_t>(column);
    }
  };

  static bool inside(const MapRegion& r, const Point2& p) {
    return p.x >= r.lower.x && p.x <= r.upper.x && p.y >= r.lower.y && p.y <= r.upper.y;
  }

  static Level halve(const Level& below) {
    Level level{(below.columns + 1) / 2, (below.rows + 1) / 2, {}};
    level.any.resize(static_cast<std::size_t>(level.columns) * static_cast<std::size_t>(level.rows));
    for (int row = 0; row < below.rows; ++row) {
      for (int column = 0; column < below.columns; ++column) {
        if (below.any[below.index(column, row)]) level.any[level.index(column / 2, row / 2)] = true;
      }
    }
    return level;
  }

  std::vector<Level> levels_;
};

/// Things to do by whole costs, the cheapest first. Nothing may be added below the cheapest.
template <class Item>
class CostQueue {
 public:
  void push(std::uint32_t cost, const Item& item) {
    if (cost >= buckets_.size()) buckets_.resize(cost + 1);
    buckets_[cost].push_back(item);
  }
  std::vector<Item>& at(std::uint32_t cost) {
    if (cost >= buckets_.size()) buckets_.resize(cost + 1);
    return buckets_[cost];
  }
  std::size_t costs() const { return buckets_.size(); }

 private:
  std::vector<std::vector<Item>> buckets_;
};

class BranchAndBound {
 public:
  BranchAndBound(const LeastCostWindows& windows, const GridGeometry& grid, const AllowedBoxes& allowed,
                 const RotatedPoints& points, const PoseSearchQuery& query)
      : windows_(windows), grid_(grid), allowed_(allowed), points_(points), query_(query) {
    for (int side = 0; side <= kLargestWindow; ++side) plane_of_side_.push_back(windows.plane_for(side));
  }

  PoseSearchResult run() {
    push_top_boxes();
    for (std::uint32_t cost = 0; cost < std::max(boxes_.costs(), leaves_.costs()); ++cost) {
      if (is_negligible(log_likelihood_of(cost * windows_.cost_per_step()))) break;
      divide_all(cost);
      if (take_all(cost)) break;
    }
    result_.lattice_poses = allowed_.cells() * points_.headings(0);
    return std::move(result_);
  }

 private:
  std::uint32_t bound(const Box& box, std::size_t first, std::size_t last) {
    const auto reaches = points_.at(box.level, box.heading);
    const int more = (1 << box.level) - 1;
    std::uint32_t cost = 0;
    for (std::size_t k = first; k < last; ++k) {
      const RotatedPoints::Reach& r = reaches[k];
      const int side = r.side + more;
      if (side > kLargestWindow) continue;
      const std::size_t plane = plane_of_side_[static_cast<std::size_t>(side)];
      cost += windows_.plane(plane).at(box.column + r.column, box.row + r.row);
    }
    result_.evaluated += static_cast<std::int64_t>(last - first);
    return cost;
  }

  std::size_t first_look() const { return std::min(kFirstLook, points_.points()); }

  void push_top_boxes() {
    const int level = kLevels - 1;
    for (int row = 0; row < allowed_.rows(level); ++row) {
      for (int column = 0; column < allowed_.columns(level); ++column) {
        if (!allowed_.any(level, column, row)) continue;
        for (int heading = 0; heading < points_.headings(level); ++heading) {
          push({column << level, row << level, heading, 0, 0, 0, static_cast<std::uint8_t>(level), true});
        }
      }
    }
  }

  // A first, rough bound: the parent's holds for its children, and so does the parent's for most points with
  // the child's own for the first ones.
  void push(Box box) {
    box.first = bound(box, 0, first_look());
    box.cost = std::max(box.cost, box.first + box.rest);
    boxes_.push(box.cost, box);
  }

  void divide_all(std::uint32_t cost) {
    while (!boxes_.at(cost).empty()) {
      const Box box = boxes_.at(cost).back();
      boxes_.at(cost).pop_back();
      if (is_settled(box)) continue;
      if (result_.evaluated > query_.budget) {
        dive(box);
      } else if (box.rough) {
        look_closer(box);
      } else if (box.level > 0) {
        for (const Box& part : parts_of(box)) push(part);
      } else {
        weigh(box);
      }
    }
  }

  void look_closer(Box box) {
    box.rest = bound(box, first_look(), points_.points());
    box.cost = std::max(box.cost, box.first + box.rest);
    box.rough = false;
    boxes_.push(box.cost, box);
  }

  std::vector<Box>& parts_of(const Box& box) {
    parts_.clear();
    const int level = box.level - 1;
    const int half = 1 << level;
    for (int part = 0; part < 8; ++part) {
      const int column = box.column + ((part & 1) != 0 ? half : 0);
      const int row = box.row + ((part & 2) != 0 ? half : 0);
      if (!allowed_.any(level, column >> level, row >> level)) continue;
      parts_.push_back({column, row, 2 * box.heading + (part >> 2), box.cost, 0, box.rest,
                        static_cast<std::uint8_t>(level), true});
    }
    return parts_;
  }

  // Out of budget: straight down to one good pose of the box.
  void dive(Box box) {
    result_.complete = false;
    if (++dives_ > kMostDives) return;
    while (box.level > 0) {
      std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
      for (const Box& part : parts_of(box)) {
        const std::uint32_t cost = bound(part, 0, points_.points());
        if (cost < least) least = cost, box = part;
      }
    }
    weigh(box);
  }

  // True if every pose of the box is one of those already found.
  bool is_settled(const Box& box) const {
    const double cells = (1 << box.level) - 1;
    const double half_m = cells / 2.0 * grid_.resolution_m;
    const double half_rad = cells / 2.0 * points_.heading_step_rad();
    const Point2 corner = grid_.center(box.column, box.row);
    const Pose2 middle =
        Pose2{corner.x, corner.y, grid_.T_map_grid.theta} *
        Pose2{half_m, half_m, (box.heading << box.level) * points_.heading_step_rad() + half_rad};
    return std::any_of(result_.poses.begin(), result_.poses.end(), [&](const FoundPose& found) {
      return distance(middle, found.T_map_base) + std::sqrt(2.0) * half_m < query_.separation_m &&
             turn_between(middle, found.T_map_base) + half_rad < query_.separation_rad;
    });
  }

  void weigh(const Box& box) {
    double cost = 0.0;
    for (const RotatedPoints::Reach& r : points_.at(0, box.heading)) {
      cost += windows_.cost(box.column + r.column, box.row + r.row);
    }
    const auto steps = static_cast<std::uint32_t>(cost / windows_.cost_per_step());
    leaves_.push(std::max(steps, box.cost), {cost, box.heading, box.row, box.column});
  }

  // Returns true when the search is over.
  bool take_all(std::uint32_t cost) {
    std::vector<Leaf>& leaves = leaves_.at(cost);
    std::sort(leaves.begin(), leaves.end());
    for (const Leaf& leaf : leaves) {
      const FoundPose found{pose_of(leaf), log_likelihood_of(leaf.cost)};
      if (!is_distinct(found.T_map_base)) continue;
      if (is_negligible(found.log_likelihood)) return true;
      result_.poses.push_back(found);
      if (result_.poses.size() == static_cast<std::size_t>(query_.most_poses)) return true;
    }
    leaves.clear();
    return false;
  }

  bool is_negligible(double log_likelihood) const {
    return !result_.poses.empty() && log_likelihood < result_.poses[0].log_likelihood - query_.margin;
  }

  double log_likelihood_of(double cost) const {
    return -cost - windows_.least() * static_cast<double>(points_.points());
  }

  Pose2 pose_of(const Leaf& leaf) const {
    const Point2 center = grid_.center(leaf.column, leaf.row);
    const double heading = leaf.heading * points_.heading_step_rad() + grid_.T_map_grid.theta;
    return {center.x, center.y, normalize_angle(heading)};
  }

  bool is_distinct(const Pose2& pose) const {
    return std::none_of(result_.poses.begin(), result_.poses.end(), [&](const FoundPose& other) {
      return distance(pose, other.T_map_base) < query_.separation_m &&
             turn_between(pose, other.T_map_base) < query_.separation_rad;
    });
  }

  const LeastCostWindows& windows_;
  const GridGeometry& grid_;
  const AllowedBoxes& allowed_;
  const RotatedPoints& points_;
  const PoseSearchQuery& query_;
  std::vector<std::size_t> plane_of_side_;
  std::vector<Box> parts_;
  int dives_ = 0;
  CostQueue<Box> boxes_;
  CostQueue<Leaf> leaves_;
  PoseSearchResult result_;
};

}  // namespace

PoseSearch::PoseSearch(const OccupancyGrid& map, const LikelihoodFieldOptions& model) {
  if (map.count(CellState::kFree) == 0)
    throw ConfigurationError("map", "has no free cell to search", "check its thresholds");
  map_ = std::make_unique<const Map>(map, model);
}
PoseSearch::~PoseSearch() = default;
PoseSearch::PoseSearch(PoseSearch&&) noexcept = default;
PoseSearch& PoseSearch::operator=(PoseSearch&&) noexcept = default;

PoseSearchResult PoseSearch::find(std::span<const Point2> points, const PoseSearchQuery& query) const {
  const std::vector<Point2> cells = spread_order(map_->in_cells(points));
  if (cells.empty() || query.most_poses < 1) return {};
  const RotatedPoints turned(cells, headings_for(cells), kLevels);
  const AllowedBoxes allowed(map_->geometry, map_->free, query.region);
  return BranchAndBound(map_->windows, map_->geometry, allowed, turned, query).run();
}

double PoseSearch::log_likelihood(std::span<const Point2> points, const Pose2& T_map_base) const {
  double sum = 0.0;
  for (const Point2& p : points) {
    const Point2 cell = map_->geometry.to_cells(T_map_base * p);
    sum -= map_->windows.cost(static_cast<int>(std::floor(cell.x)), static_cast<int>(std::floor(cell.y))) +
           map_->windows.least();
  }
  return sum;
}

}  // namespace cairn
