#include "cairn/models/search/pose_search.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/models/search/block_sums.hpp"
#include "cairn/models/search/least_cost_windows.hpp"
#include "cairn/models/search/rotated_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace cairn {
namespace {

constexpr int kTiers = LeastCostWindows::kTiers;
constexpr int kLevels = 2 * kTiers - 1;  // of headings: those of boxes, and halves of them
constexpr double kFarthest_cells = 16000.0;
constexpr double kSteeringShare = 0.9;  // share of the points that the headings' step must not move by a cell
constexpr std::size_t kFirstLook = 4;   // a quarter of the points: a box's first, rough bound
constexpr int kMostDives = 1000;

double turn_between(const Pose2& a, const Pose2& b) { return std::abs(normalize_angle(a.theta - b.theta)); }

/// What may still hold the best pose: 4^tier x 4^tier cells from (column, row), 4^tier headings.
struct Box {
  std::int32_t column;
  std::int32_t row;
  std::int32_t heading;  // index of the group at its tier
  std::uint32_t cost;    // bound, in steps
  std::uint32_t rest;    // share of the points after the first look
  std::uint8_t tier;
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
      : box(known_cells(map, field)), windows(field, model, box) {
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

/// Costs that some distinct poses are known to have: what the last of the poses to be found cannot exceed.
class Incumbents {
 public:
  explicit Incumbents(const PoseSearchQuery& query) : query_(query) {}

  void add(const FoundPose& pose) {
    best_ = std::max(best_, pose.log_likelihood);
    const auto near = [&](const FoundPose& other) {
      return distance(pose.T_map_base, other.T_map_base) < 2.0 * query_.separation_m &&
             turn_between(pose.T_map_base, other.T_map_base) < 2.0 * query_.separation_rad;
    };
    const auto better = [&](const FoundPose& other) {
      return near(other) && other.log_likelihood >= pose.log_likelihood;
    };
    if (std::any_of(poses_.begin(), poses_.end(), better)) return;
    poses_.erase(std::remove_if(poses_.begin(), poses_.end(), near), poses_.end());
    poses_.insert(std::upper_bound(poses_.begin(), poses_.end(), pose,
                                   [](const FoundPose& a, const FoundPose& b) {
                                     return a.log_likelihood > b.log_likelihood;
                                   }),
                  pose);
    const auto most = static_cast<std::size_t>(query_.most_poses);
    if (poses_.size() > most) poses_.pop_back();
    if (poses_.size() == most) least_ = std::max(least_, poses_.back().log_likelihood);
  }

  /// No pose that the search has to find is less likely. So many poses, twice as far apart as distinct ones
  /// must be: one that was found is near to one of them at most, so that there is always one of them left.
  double least() const { return std::max(least_, best_ - query_.margin); }

 private:
  const PoseSearchQuery& query_;
  std::vector<FoundPose> poses_;
  double best_ = -std::numeric_limits<double>::infinity();
  double least_ = -std::numeric_limits<double>::infinity();
};

class BranchAndBound {
 public:
  BranchAndBound(const LeastCostWindows& windows, const GridGeometry& grid, const AllowedBoxes& allowed,
                 const RotatedPoints& points, const PoseSearchQuery& query)
      : windows_(windows), grid_(grid), allowed_(allowed), points_(points), query_(query), known_(query) {
    for (int tier = 0; tier < kTiers; ++tier) {
      for (int side = 0; side <= LeastCostWindows::kLargest; ++side)
        planes_[static_cast<std::size_t>(tier)].push_back(windows.plane_for(tier, side));
    }
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
  /// Adds the costs of points [first, last) in the 4 x 4 boxes of a tier from (column, row).
  void add(BlockSums& sums, int tier, int heading, const Box& from, std::size_t first, std::size_t last) {
    const auto reaches = points_.at(2 * tier, heading);
    const auto& planes = planes_[static_cast<std::size_t>(tier)];
    const int more = LeastCostWindows::stride(tier) - 1;
    for (std::size_t k = first; k < last; ++k) {
      const RotatedPoints::Reach& r = reaches[k];
      const int side = r.side + more;
      const auto* plane =
          side > LeastCostWindows::kLargest ? nullptr : planes[static_cast<std::size_t>(side)];
      if (plane == nullptr) continue;  // no bound
      sums.add(plane->block(from.column + r.column, from.row + r.row));
    }
    result_.evaluated += static_cast<std::int64_t>(last - first);
  }

  std::size_t first_look() const { return points_.points() / kFirstLook; }

  /// The 4 x 4 boxes of a tier from where `from` begins, for one group of headings: those that may hold what
  /// is looked for. First a few points, with the parent's bound for all others.
  void bound(const Box& from, int tier, int heading, std::vector<Box>& parts) {
    BlockSums sums;
    add(sums, tier, heading, from, 0, first_look());
    const BlockSums::Sums first = sums.sums();
    if (*std::min_element(first.begin(), first.end()) + from.rest > most_) return;
    add(sums, tier, heading, from, first_look(), points_.points());
    const BlockSums::Sums& all = sums.sums();
    const int step = LeastCostWindows::stride(tier);
    for (int i = 0; i < 16; ++i) {
      const auto n = static_cast<std::size_t>(i);
      const Box part{from.column + i % 4 * step,  from.row + i / 4 * step, heading,
                     std::max(from.cost, all[n]), all[n] - first[n],       static_cast<std::uint8_t>(tier)};
      if (part.cost <= most_ && allowed_.any(2 * tier, part.column / step, part.row / step))
        parts.push_back(part);
    }
  }

  void push_top_boxes() {
    constexpr int kTop = kTiers - 1;
    const int step = 4 * LeastCostWindows::stride(kTop);
    for (int row = 0; row < grid_.height; row += step) {
      for (int column = 0; column < grid_.width; column += step) {
        parts_.clear();
        for (int heading = 0; heading < points_.headings(2 * kTop); ++heading)
          bound({column, row, 0, 0, 0, kTiers}, kTop, heading, parts_);
        for (const Box& part : parts_) boxes_.push(part.cost, part);
      }
    }
  }

  void divide_all(std::uint32_t cost) {
    while (!boxes_.at(cost).empty()) {
      const Box box = boxes_.at(cost).back();
      boxes_.at(cost).pop_back();
      if (is_settled(box)) continue;
      if (box.tier == 0) {
        weigh(box);
      } else if (result_.evaluated > query_.budget) {
        dive(box);
      } else {
        for (const Box& part : parts_of(box)) boxes_.push(part.cost, part);
      }
    }
  }

  const std::vector<Box>& parts_of(const Box& box) {
    parts_.clear();
    for (int part = 0; part < 4; ++part) bound(box, box.tier - 1, 4 * box.heading + part, parts_);
    if (box.tier == 1) learn(parts_);
    return parts_;
  }

  // The best of some poses may lower what is still worth looking at.
  void learn(const std::vector<Box>& parts) {
    if (parts.empty()) return;
    const Leaf leaf = leaf_of(*std::min_element(parts.begin(), parts.end(),
                                                [](const Box& a, const Box& b) { return a.cost < b.cost; }));
    known_.add({pose_of(leaf), log_likelihood_of(leaf.cost)});
    const double steps = cost_of(known_.least()) / windows_.cost_per_step();
    if (steps < static_cast<double>(most_)) most_ = static_cast<std::uint32_t>(std::max(0.0, steps)) + 1;
  }

  // Out of budget: straight down to one good pose of the box.
  void dive(Box box) {
    result_.complete = false;
    if (++dives_ > kMostDives) return;
    while (box.tier > 0) {
      const std::vector<Box>& parts = parts_of(box);
      if (parts.empty()) return;
      box = *std::min_element(parts.begin(), parts.end(),
                              [](const Box& a, const Box& b) { return a.cost < b.cost; });
    }
    weigh(box);
  }

  // True if every pose of the box is one of those already found.
  bool is_settled(const Box& box) const {
    const int side = LeastCostWindows::stride(box.tier);
    const double cells = side - 1;
    const double half_m = cells / 2.0 * grid_.resolution_m;
    const double half_rad = cells / 2.0 * points_.heading_step_rad();
    const Point2 corner = grid_.center(box.column, box.row);
    const Pose2 middle = Pose2{corner.x, corner.y, grid_.T_map_grid.theta} *
                         Pose2{half_m, half_m, box.heading * side * points_.heading_step_rad() + half_rad};
    return std::any_of(result_.poses.begin(), result_.poses.end(), [&](const FoundPose& found) {
      return distance(middle, found.T_map_base) + std::sqrt(2.0) * half_m < query_.separation_m &&
             turn_between(middle, found.T_map_base) + half_rad < query_.separation_rad;
    });
  }

  Leaf leaf_of(const Box& box) const {
    double cost = 0.0;
    for (const RotatedPoints::Reach& r : points_.at(0, box.heading))
      cost += windows_.cost(box.column + r.column, box.row + r.row);
    return {cost, box.heading, box.row, box.column};
  }

  void weigh(const Box& box) {
    const Leaf leaf = leaf_of(box);
    const auto steps = static_cast<std::uint32_t>(leaf.cost / windows_.cost_per_step());
    leaves_.push(std::max(steps, box.cost), leaf);
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
  double cost_of(double log_likelihood) const {
    return -log_likelihood - windows_.least() * static_cast<double>(points_.points());
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
  std::array<std::vector<const LeastCostWindows::Plane*>, kTiers> planes_;  ///< by the side of the window
  Incumbents known_;
  std::uint32_t most_ = std::numeric_limits<std::uint32_t>::max();  ///< boxes that cost more are not needed
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
  const Pose2 T_grid_base = inverse(map_->geometry.T_map_grid) * T_map_base;
  const double per_m = 1.0 / map_->geometry.resolution_m;
  const double x = per_m * T_grid_base.x, y = per_m * T_grid_base.y;
  const double c = per_m * std::cos(T_grid_base.theta), s = per_m * std::sin(T_grid_base.theta);
  double sum = 0.0;
  for (const Point2& p : points) {
    const double column = std::floor(x + c * p.x - s * p.y), row = std::floor(y + s * p.x + c * p.y);
    sum -= map_->windows.cost(static_cast<int>(column), static_cast<int>(row)) + map_->windows.least();
  }
  return sum;
}

}  // namespace cairn
