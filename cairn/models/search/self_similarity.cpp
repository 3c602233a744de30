#include "cairn/models/search/self_similarity.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/maps/distance_field.hpp"
#include "cairn/maps/ray_marching.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

namespace cairn {
namespace {

constexpr std::size_t kNeighbours = 600;  // most of them are the place itself
constexpr std::size_t kClimbs = 8;
constexpr double kFirstStep_rad = 0.1;
constexpr int kHalvings = 6;
constexpr std::size_t kPositionsPerTask = 8;
constexpr std::size_t kTasksPerReport = 32;
constexpr double kNever = std::numeric_limits<double>::infinity();

bool apart(const Pose2& a, const Pose2& b, const SelfSimilarityOptions& o) {
  return distance(a, b) >= o.apart_m || std::abs(normalize_angle(a.theta - b.theta)) >= o.apart_rad;
}

/// The scans that a scanner would take on a grid of positions and headings, each bound to the map.
class ExpectedScans {
 public:
  ExpectedScans(const OccupancyGrid& map, const PlaceIndex& index, const LikelihoodFieldOptions& likelihood,
                double range_m, const SelfSimilarityOptions& options)
      : index_(index),
        rays_(map, range_m),
        range_m_(range_m),
        half_cell_(static_cast<float>(0.5 * map.geometry().resolution_m)),
        step_(std::max(1, index.headings() / options.headings)),
        headings_(static_cast<std::size_t>((index.headings() + step_ - 1) / step_)),
        model_(std::make_shared<const DistanceField>(map, likelihood.max_distance_m), Pose2{}, {},
               likelihood) {
    const double view = index.shape().last_bearing_rad - index.shape().first_bearing_rad;
    for (int k = 0; k < options.beams; ++k)
      bearings_.push_back(index.shape().first_bearing_rad + view * (k + 0.5) / options.beams);
    bound_.resize(positions() * headings_);
    own_.resize(bound_.size());
  }

  std::size_t positions() const { return index_.size() / static_cast<std::size_t>(index_.headings()); }
  std::size_t headings() const { return headings_; }
  std::size_t place(std::size_t position, std::size_t heading) const {
    return position * static_cast<std::size_t>(index_.headings()) + heading * static_cast<std::size_t>(step_);
  }
  Pose2 pose(std::size_t position, std::size_t heading) const {
    return index_.place(place(position, heading)).T_map_sensor;
  }

  void take(std::size_t position) {
    std::vector<Pose2> poses;
    for (std::size_t h = 0; h < headings_; ++h) poses.push_back(pose(position, h));
    std::vector<float> ranges(poses.size() * bearings_.size());
    rays_.cast(poses, bearings_, ranges);
    LaserScan scan;
    scan.angle_min_rad = bearings_.front();
    scan.angle_increment_rad = bearings_.size() > 1 ? bearings_[1] - bearings_[0] : 0.0;
    scan.range_max_m = range_m_;
    for (std::size_t h = 0; h < headings_; ++h) {
      const auto first = ranges.begin() + static_cast<std::ptrdiff_t>(h * bearings_.size());
      scan.ranges_m.assign(first, first + static_cast<std::ptrdiff_t>(bearings_.size()));
      for (float& range : scan.ranges_m) range += half_cell_;
      bound_[position * headings_ + h] = model_.bind(scan);
      own_[position * headings_ + h] = log_likelihood(position, h, poses[h]);
    }
  }

  double log_likelihood(std::size_t position, std::size_t heading, const Pose2& at) const {
    double value = 0.0;
    bound_[position * headings_ + heading].log_likelihood(std::span(&at, 1), std::span(&value, 1));
    return value;
  }
  /// Of the scan taken there, at another pose, less that at its own.
  double log_ratio(std::size_t position, std::size_t heading, const Pose2& at) const {
    return log_likelihood(position, heading, at) - own_[position * headings_ + heading];
  }

 private:
  const PlaceIndex& index_;
  RayMarcher rays_;
  double range_m_;
  float half_cell_;  ///< a ray ends at the side of a cell, a wall is taken to stand in its middle
  int step_;
  std::size_t headings_;
  LikelihoodField model_;
  std::vector<double> bearings_;
  std::vector<BoundUpdate<Pose2>> bound_;
  std::vector<double> own_;  ///< log-likelihood of each at its own pose
};

// The best pose nearby, by pattern search: along x, y and heading, with halved steps where none is better.
Alternative climb(const ExpectedScans& scans, std::size_t position, std::size_t heading, Pose2 at,
                  double step_m) {
  double value = scans.log_ratio(position, heading, at);
  double step_rad = kFirstStep_rad;
  for (int halved = 0; halved <= kHalvings;) {
    const std::array<Pose2, 6> around = {{{at.x + step_m, at.y, at.theta},
                                          {at.x - step_m, at.y, at.theta},
                                          {at.x, at.y + step_m, at.theta},
                                          {at.x, at.y - step_m, at.theta},
                                          {at.x, at.y, normalize_angle(at.theta + step_rad)},
                                          {at.x, at.y, normalize_angle(at.theta - step_rad)}}};
    bool better = false;
    for (const Pose2& next : around) {
      const double there = scans.log_ratio(position, heading, next);
      if (there > value + 1e-9) value = there, at = next, better = true;
    }
    if (!better) step_m *= 0.5, step_rad *= 0.5, ++halved;
  }
  return {at, value};
}

/// Finds the alternatives to one place.
class AlternativeFinder {
 public:
  AlternativeFinder(const PlaceIndex& index, const ExpectedScans& scans, const SelfSimilarityOptions& options)
      : index_(index), scans_(scans), options_(options) {}

  std::vector<Alternative> find(std::size_t position, std::size_t heading) const {
    const Pose2 own = scans_.pose(position, heading);
    std::vector<Pose2> starts;
    std::vector<Alternative> found;
    for (const auto& neighbour :
         index_.nearest(index_.signatures()[scans_.place(position, heading)], kNeighbours)) {
      const Pose2 start = index_.place(neighbour.place).T_map_sensor;
      if (!apart(start, own, options_) || known(starts, start)) continue;
      starts.push_back(start);
      const Alternative best = climb(scans_, position, heading, start, 0.5 * index_.spacing_m());
      if (best.log_ratio >= -options_.margin && apart(best.T_map_sensor, own, options_))
        found.push_back(best);
      if (starts.size() == kClimbs) break;
    }
    return distinct(std::move(found));
  }

  /// Those of `T_other_own` (other pose = T_other_own * pose) that explain the scan of this heading, too.
  std::vector<Alternative> confirm(std::size_t position, std::size_t heading,
                                   const std::vector<Pose2>& T_other_own) const {
    std::vector<Alternative> found;
    for (const Pose2& T : T_other_own) {
      const Alternative best =
          climb(scans_, position, heading, T * scans_.pose(position, heading), 0.5 * index_.spacing_m());
      if (best.log_ratio >= -options_.margin) found.push_back(best);
    }
    return distinct(std::move(found));
  }

 private:
  bool known(const std::vector<Pose2>& poses, const Pose2& pose) const {
    return std::any_of(poses.begin(), poses.end(), [&](const Pose2& p) { return !apart(p, pose, options_); });
  }

  std::vector<Alternative> distinct(std::vector<Alternative> found) const {
    std::stable_sort(found.begin(), found.end(),
                     [](const Alternative& a, const Alternative& b) { return a.log_ratio > b.log_ratio; });
    std::vector<Alternative> kept;
    for (const Alternative& a : found) {
      const bool again = std::any_of(kept.begin(), kept.end(), [&](const Alternative& k) {
        return !apart(k.T_map_sensor, a.T_map_sensor, options_);
      });
      if (!again && kept.size() < static_cast<std::size_t>(options_.most_alternatives)) kept.push_back(a);
    }
    return kept;
  }

  const PlaceIndex& index_;
  const ExpectedScans& scans_;
  const SelfSimilarityOptions& options_;
};

/// Which positions of the index are beside each other.
class Neighbourhood {
 public:
  Neighbourhood(const ExpectedScans& scans, double spacing_m) : spacing_m_(spacing_m) {
    for (std::size_t i = 0; i < scans.positions(); ++i) {
      points_.push_back({scans.pose(i, 0).x, scans.pose(i, 0).y});
      squares_.emplace_back(square_of(points_.back()), i);
    }
    std::sort(squares_.begin(), squares_.end());
  }

  template <class Visit>
  void for_each_beside(std::size_t position, const Visit& visit) const {
    const auto [column, row] = square_of(points_[position]);
    for (int dc = -1; dc <= 1; ++dc) {
      for (int dr = -1; dr <= 1; ++dr) {
        const std::pair<Square, std::size_t> key{{column + dc, row + dr}, 0};
        for (auto it = std::lower_bound(squares_.begin(), squares_.end(), key);
             it != squares_.end() && it->first == key.first; ++it) {
          const double step = std::hypot(points_[it->second].x - points_[position].x,
                                         points_[it->second].y - points_[position].y);
          if (it->second != position && step <= 1.6 * spacing_m_) visit(it->second, step);
        }
      }
    }
  }

 private:
  using Square = std::pair<int, int>;
  Square square_of(const Point2& p) const {
    return {static_cast<int>(std::floor(p.x / spacing_m_)), static_cast<int>(std::floor(p.y / spacing_m_))};
  }
  double spacing_m_;
  std::vector<Point2> points_;
  std::vector<std::pair<Square, std::size_t>> squares_;
};

/// Whether a scan taken at a position, in whatever heading, tells apart two poses of which one is at
/// T_other_own times the other. What is known of the other pose is only as good as the last scans made it:
/// T_other_own follows what is seen here, as a belief would.
bool told_apart(const ExpectedScans& scans, std::size_t position, const SelfSimilarityOptions& options,
                Pose2& T_other_own) {
  for (std::size_t h = 0; h < scans.headings(); ++h) {
    const Pose2 own = scans.pose(position, h);
    const Alternative best = climb(scans, position, h, T_other_own * own, 0.25 * options.apart_m);
    if (best.log_ratio < -options.margin) return true;
    T_other_own = best.T_map_sensor * inverse(own);
  }
  return false;
}

/// Shortest drive (Dijkstra 1959) to a position where a scan tells two poses apart that move alike.
double shortest_resolving_drive(std::size_t from, const Pose2& T_other_own, const ExpectedScans& scans,
                                const Neighbourhood& beside, const SelfSimilarityOptions& options) {
  using Reached = std::pair<double, std::size_t>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  std::vector<double> driven(scans.positions(), kNever);
  std::vector<Pose2> followed(scans.positions());
  driven[from] = 0.0;
  followed[from] = T_other_own;
  open.emplace(0.0, from);
  while (!open.empty()) {
    const double so_far = open.top().first;
    const std::size_t position = open.top().second;
    open.pop();
    if (so_far > driven[position]) continue;
    if (told_apart(scans, position, options, followed[position])) return so_far;
    beside.for_each_beside(position, [&](std::size_t next, double step) {
      const double there = so_far + step;
      if (there >= driven[next] || there > options.farthest_drive_m) return;
      driven[next] = there;
      followed[next] = followed[position];
      open.emplace(there, next);
    });
  }
  return kNever;
}

/// What is seen from one position. Who may turn looks where the fewest other poses see the same.
struct Outlook {
  SelfSimilarPlace place;
  Pose2 T_map_clearest;  ///< the position, in the heading with the fewest alternatives
  std::vector<Alternative> fewest;
};

Outlook look_around(std::size_t position, const AlternativeFinder& finder, const ExpectedScans& scans) {
  Outlook out;
  out.place.T_map_sensor = scans.pose(position, 0);
  std::size_t ambiguous = 0, clearest = 0, least = std::numeric_limits<std::size_t>::max();
  std::vector<Pose2> T_other_own;
  for (std::size_t h = 0; h < scans.headings(); ++h) {
    const Pose2 own = scans.pose(position, h);
    const std::vector<Alternative> found = finder.find(position, h);
    for (const Alternative& a : found) T_other_own.push_back(a.T_map_sensor * inverse(own));
    if (found.size() < least) least = found.size(), clearest = h;
    if (found.empty()) continue;
    ++ambiguous;
    std::vector<Alternative>& best = out.place.alternatives;
    if (!best.empty() && best[0].log_ratio >= found[0].log_ratio) continue;
    best = found;
    out.place.T_map_sensor = own;
  }
  out.T_map_clearest = scans.pose(position, clearest);
  out.fewest = finder.confirm(position, clearest, T_other_own);
  out.place.ambiguous_headings = static_cast<double>(ambiguous) / static_cast<double>(scans.headings());
  return out;
}

/// Work on all positions in fixed tasks, with a report now and then.
template <class Work>
void for_all(std::size_t positions, const Executor& executor, const std::function<void(double)>& on_progress,
             double from, double to, const Work& work) {
  constexpr std::size_t kBatch = kPositionsPerTask * kTasksPerReport;
  for (std::size_t first = 0; first < positions; first += kBatch) {
    const std::size_t count = std::min(kBatch, positions - first);
    executor.for_each_chunk(count, kPositionsPerTask, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) work(first + i);
    });
    if (on_progress)
      on_progress(from + (to - from) * static_cast<double>(first + count) / static_cast<double>(positions));
  }
}

}  // namespace

void SelfSimilarityOptions::validate() const {
  const auto refuse = [](const char* what) {
    throw ConfigurationError(what, "is out of range", "see `cairn map ambiguity --help`");
  };
  if (!(apart_m > 0.0 && apart_m < 1e6)) refuse("apart_m");
  if (!(apart_rad > 0.0 && apart_rad < 7.0)) refuse("apart_rad");
  if (!(margin > 0.0 && margin < 1e6)) refuse("margin");
  if (headings < 1 || headings > 360) refuse("headings");
  if (beams < 3 || beams > 10000) refuse("beams");
  if (most_alternatives < 1) refuse("most_alternatives");
  if (!(farthest_drive_m >= 0.0 && farthest_drive_m < 1e6)) refuse("farthest_drive_m");
}

std::vector<SelfSimilarPlace> find_self_similarity(const OccupancyGrid& map, const PlaceIndex& index,
                                                   const LikelihoodFieldOptions& likelihood, double range_m,
                                                   const SelfSimilarityOptions& options,
                                                   const Executor& executor,
                                                   const std::function<void(double)>& on_progress) {
  options.validate();
  ExpectedScans scans(map, index, likelihood, range_m, options);
  for_all(scans.positions(), executor, on_progress, 0.0, 0.05, [&](std::size_t i) { scans.take(i); });
  std::vector<Outlook> outlooks(scans.positions());
  const AlternativeFinder finder(index, scans, options);
  for_all(outlooks.size(), executor, on_progress, 0.05, 0.6,
          [&](std::size_t i) { outlooks[i] = look_around(i, finder, scans); });
  const Neighbourhood beside(scans, index.spacing_m());
  for_all(outlooks.size(), executor, on_progress, 0.6, 1.0, [&](std::size_t i) {
    for (const Alternative& other : outlooks[i].fewest) {
      const Pose2 T_other_own = other.T_map_sensor * inverse(outlooks[i].T_map_clearest);
      const double drive_m = shortest_resolving_drive(i, T_other_own, scans, beside, options);
      outlooks[i].place.resolved_after_m = std::max(outlooks[i].place.resolved_after_m, drive_m);
    }
  });
  std::vector<SelfSimilarPlace> places;
  places.reserve(outlooks.size());
  for (Outlook& outlook : outlooks) places.push_back(std::move(outlook.place));
  return places;
}

}  // namespace cairn
