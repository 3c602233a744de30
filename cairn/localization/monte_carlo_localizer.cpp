#include "cairn/localization/monte_carlo_localizer.hpp"

#include "cairn/bayes/clustering.hpp"
#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/localization/recipes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cairn {
namespace {

constexpr std::size_t kMostPendingScans = 1000;
// A scan after the last odometry is still used if the robot cannot have gone far.
constexpr double kExtrapolation_s = 0.5;

std::vector<std::size_t> free_cells(const OccupancyGrid& map) {
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < map.geometry().size(); ++i) {
    if (map.state(i) == CellState::kFree) cells.push_back(i);
  }
  return cells;
}

// Uniform over the free cells and all headings.
Pose2 sample_anywhere(const GridGeometry& grid, const std::vector<std::size_t>& cells,
                      const RandomStream& random, std::uint32_t item) {
  const auto u = random.uniform4(item);
  const std::size_t cell = cells[static_cast<std::size_t>(u[0] * static_cast<double>(cells.size()))];
  const auto width = static_cast<std::size_t>(grid.width);
  const Point2 p = grid.T_map_grid * Point2{(static_cast<double>(cell % width) + u[1]) * grid.resolution_m,
                                            (static_cast<double>(cell / width) + u[2]) * grid.resolution_m};
  return {p.x, p.y, normalize_angle(kTwoPi * u[3] - kPi)};
}

Pose2 sample_near(const Pose2& mean, const InitialOptions& o, const RandomStream& random,
                  std::uint32_t item) {
  const auto n = random.normal4(item);
  return {mean.x + o.sigma_x_m * n[0], mean.y + o.sigma_y_m * n[1],
          normalize_angle(mean.theta + o.sigma_yaw_rad * n[2])};
}

const char* defect(const LaserScan& scan) {
  if (scan.ranges_m.empty()) return "has no beams";
  if (!std::isfinite(scan.angle_min_rad) || !std::isfinite(scan.angle_increment_rad))
    return "has angles that are not finite";
  if (scan.ranges_m.size() > 1 && scan.angle_increment_rad == 0.0) return "has an angle increment of 0";
  const auto valid = [&](float r) { return scan.is_valid_range(r); };
  if (std::none_of(scan.ranges_m.begin(), scan.ranges_m.end(), valid)) return "has no valid range";
  return nullptr;
}

}  // namespace

MonteCarloLocalizer::MonteCarloLocalizer(const LocalizerOptions& options,
                                         const std::vector<StreamInfo>& streams, const OccupancyGrid& map,
                                         const Start& start, std::uint64_t seed,
                                         std::shared_ptr<const Executor> executor)
    : options_(options), filter_(make_filter(options, seed, std::move(executor))), outcomes_(streams.size()) {
  options_.validate();
  bind_streams(streams, map);
  initialize(map, start);
}

void MonteCarloLocalizer::initialize(const OccupancyGrid& map, const Start& start) {
  if (!start.T_map_base) {
    const std::vector<std::size_t> cells = free_cells(map);
    if (cells.empty())
      throw ConfigurationError("map", "has no free cell to start from", "check its thresholds");
    filter_.initialize([&](const RandomStream& random, std::uint32_t i) {
      return sample_anywhere(map.geometry(), cells, random, i);
    });
    return;
  }
  const Pose2& pose = *start.T_map_base;
  const Point2 cell = map.geometry().to_cells({pose.x, pose.y});
  if (!is_finite(pose) ||
      !map.geometry().contains(static_cast<int>(std::floor(cell.x)), static_cast<int>(std::floor(cell.y)))) {
    throw ConfigurationError("start pose", "lies off the map", "give x and y in metres, in the map's frame");
  }
  filter_.initialize([&](const RandomStream& random, std::uint32_t i) {
    return sample_near(pose, options_.initial, random, i);
  });
}

Outcome MonteCarloLocalizer::process(const Event& event) {
  if (event.stream >= outcomes_.size()) return Outcome::kDroppedUnboundStream;
  const Outcome outcome =
      std::visit([&](const auto& payload) { return take(event.stream, payload); }, event.payload);
  count(event.stream, outcome);
  use_pending();
  return outcome;
}

Outcome MonteCarloLocalizer::take(StreamId stream, const Odometry& odometry) {
  if (stream != odometry_stream_) return Outcome::kDroppedUnboundStream;
  if (!is_finite(odometry.T_odom_base)) return Outcome::kDroppedMalformed;
  if (!odometry_.empty() && odometry.stamp <= odometry_.newest()) return Outcome::kDroppedOutOfOrder;
  odometry_.add(odometry);
  return Outcome::kUsed;
}

Outcome MonteCarloLocalizer::take(StreamId stream, const std::shared_ptr<const LaserScan>& scan) {
  if (!laser_models_[stream].fine) return Outcome::kDroppedUnboundStream;
  const char* what = scan ? defect(*scan) : "is missing";
  if (what != nullptr) {
    diagnostics_.warn("malformed scan", "stream " + stream_names_[stream], what);
    return Outcome::kDroppedMalformed;
  }
  if (belief_stamp_ && scan->stamp < *belief_stamp_) return Outcome::kDroppedOutOfOrder;
  const auto later = std::upper_bound(pending_.begin(), pending_.end(), scan->stamp,
                                      [](Time t, const PendingScan& p) { return t < p.scan->stamp; });
  pending_.insert(later, {stream, scan});
  return Outcome::kPending;
}

// Uses the scans around which the odometry is known, oldest first.
void MonteCarloLocalizer::use_pending() {
  while (!pending_.empty()) {
    const PendingScan next = pending_.front();
    const bool too_old = !odometry_.empty() && next.scan->stamp < odometry_.oldest();
    const auto T_odom_base = odometry_.pose_at(next.scan->stamp);
    if (!T_odom_base && !too_old && pending_.size() <= kMostPendingScans) return;
    pending_.pop_front();
    --outcomes_[next.stream][static_cast<std::size_t>(Outcome::kPending)];
    count(next.stream, T_odom_base ? use(next, *T_odom_base) : Outcome::kDroppedNoOdometry);
  }
}

void MonteCarloLocalizer::finish() {
  while (!pending_.empty()) {
    const PendingScan next = pending_.front();
    pending_.pop_front();
    --outcomes_[next.stream][static_cast<std::size_t>(Outcome::kPending)];
    const bool close =
        !odometry_.empty() && to_seconds(next.scan->stamp - odometry_.newest()) <= kExtrapolation_s;
    count(next.stream, close ? use(next, odometry_.newest_pose()) : Outcome::kDroppedNoOdometry);
  }
}

Outcome MonteCarloLocalizer::use(const PendingScan& pending, const Pose2& T_odom_base) {
  const LaserScan& scan = *pending.scan;
  const bool first = !belief_stamp_;
  const Pose2 T_last_now = first ? Pose2{} : between(T_odom_base_at_update_, T_odom_base);
  belief_stamp_ = scan.stamp;
  odometry_.forget_before(scan.stamp);
  const bool update = first || moved_enough(T_last_now);
  if (update) {
    const LaserModels& models = laser_models_[pending.stream];
    filter_.update(T_last_now, (filter_.compact() ? models.fine : models.coarse)->bind(scan));
    T_odom_base_at_update_ = T_odom_base;
    at_update_ = summarize(scan, *models.fine);
    ++updates_;
  }
  estimate_ = at_update_;
  estimate_->stamp = scan.stamp;
  if (!update) estimate_->T_map_base = at_update_.T_map_base * T_last_now;
  if (observer_) observer_(*estimate_);
  return update ? Outcome::kUsed : Outcome::kNotNeeded;
}

bool MonteCarloLocalizer::moved_enough(const Pose2& T_last_now) const {
  return std::hypot(T_last_now.x, T_last_now.y) >= options_.update.min_translation_m ||
         std::abs(T_last_now.theta) >= options_.update.min_rotation_rad;
}

Estimate MonteCarloLocalizer::summarize(const LaserScan& scan, const LikelihoodField& model) const {
  const ParticleSet<Pose2>& particles = filter_.particles();
  std::vector<double> weights(particles.size());
  std::transform(particles.log_weights.begin(), particles.log_weights.end(), weights.begin(),
                 [](double w) { return std::exp(w); });
  const Clusters clusters = cluster_poses(particles.states, weights, {});
  if (!clusters.weight.empty()) {
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = clusters.label[i] == 0 ? weights[i] : 0.0;
  }
  const PoseMoments moments = weighted_moments(particles.states, weights);
  return {.stamp = scan.stamp,
          .T_map_base = moments.mean,
          .covariance = moments.covariance,
          .ess = filter_.ess(),
          .particles = static_cast<int>(particles.size()),
          .hypotheses = std::max(1, static_cast<int>(clusters.weight.size())),
          .weight = clusters.weight.empty() ? 1.0 : clusters.weight[0],
          .quality = model.explained_share(scan, moments.mean)};
}

ParticleSnapshot MonteCarloLocalizer::snapshot(std::size_t at_most) const {
  ParticleSnapshot snapshot{belief_stamp_.value_or(Time{}), {}};
  if (!belief_stamp_ || at_most == 0) return snapshot;
  const ParticleSet<Pose2>& particles = filter_.particles();
  std::vector<std::uint32_t> chosen;
  const std::size_t count = std::min(at_most, particles.size());
  draw_systematic(cumulative_weights(particles.log_weights), count, 0.5, chosen);
  const Pose2 T_then_now = between(at_update_.T_map_base, estimate_->T_map_base);
  for (const std::uint32_t i : chosen) snapshot.particles.push_back(particles.states[i] * T_then_now);
  return snapshot;
}

void MonteCarloLocalizer::count(StreamId stream, Outcome outcome) {
  ++outcomes_[stream][static_cast<std::size_t>(outcome)];
}

}  // namespace cairn
