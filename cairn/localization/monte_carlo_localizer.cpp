#include "cairn/localization/monte_carlo_localizer.hpp"

#include "cairn/bayes/clustering.hpp"
#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/localization/event_check.hpp"
#include "cairn/localization/recipes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cairn {
namespace {

constexpr std::size_t kMostPendingScans = 1000;
// A scan after the last odometry is still used if the robot cannot have gone far.
constexpr double kExtrapolation_s = 0.5;

Pose2 sample_near(const Pose2& mean, const InitialOptions& o, const RandomStream& random,
                  std::uint32_t item) {
  const auto n = random.normal4(item);
  return {mean.x + o.sigma_x_m * n[0], mean.y + o.sigma_y_m * n[1],
          normalize_angle(mean.theta + o.sigma_yaw_rad * n[2])};
}

const LocalizerOptions& validated(const LocalizerOptions& options) {
  options.validate();
  return options;
}

}  // namespace

MonteCarloLocalizer::MonteCarloLocalizer(const LocalizerOptions& options,
                                         const std::vector<StreamInfo>& streams, const MapLibrary& maps,
                                         const Start& start, std::uint64_t seed,
                                         std::shared_ptr<const Executor> executor)
    : options_(validated(options)),
      executor_(std::move(executor)),
      filter_(make_filter(options, seed, executor_)),
      last_used_(streams.size()),
      outcomes_(streams.size()) {
  bind_streams(streams, maps);
  const auto map = maps.main().grid();
  if (start.T_map_base) {
    start_near(*start.T_map_base, map->geometry());
  } else {
    global_start_.emplace(*map, options_.global.candidates_per_m2, seed);
  }
}

void MonteCarloLocalizer::start_near(const Pose2& pose, const GridGeometry& grid) {
  const Point2 cell = grid.to_cells({pose.x, pose.y});
  const bool on_map =
      is_finite(pose) && cell.x >= 0.0 && cell.x < grid.width && cell.y >= 0.0 && cell.y < grid.height;
  if (!on_map) {
    throw ConfigurationError("start pose", "lies off the map",
                             "give x and y in metres, in the map's frame (see `cairn map info`)");
  }
  filter_.initialize([&](const RandomStream& random, std::uint32_t i) {
    return sample_near(pose, options_.initial, random, i);
  });
}

// The first scan of a robot that may be anywhere makes the first particles; it must not weigh them once more.
void MonteCarloLocalizer::start_anywhere(const BoundUpdate<Pose2>& z) {
  global_start_->weigh(z, *executor_);
  filter_.initialize(
      [&](const RandomStream& random, std::uint32_t i) { return global_start_->sample(random, i); });
  global_start_.reset();
}

Outcome MonteCarloLocalizer::process(const Event& event) {
  if (event.stream >= outcomes_.size()) {
    diagnostics_.warn("event of an unknown stream", "stream " + std::to_string(event.stream),
                      "the table has " + std::to_string(outcomes_.size()) + " streams");
    return Outcome::kDroppedUnboundStream;
  }
  ++event_number_;
  event_outcome_ = take(event);
  count(event.stream, event_outcome_);
  use_pending();
  return event_outcome_;
}

Outcome MonteCarloLocalizer::take(const Event& event) {
  const auto* odometry = std::get_if<Odometry>(&event.payload);
  const bool bound =
      odometry != nullptr ? event.stream == odometry_stream_ : laser_models_[event.stream].fine != nullptr;
  if (!bound) return Outcome::kDroppedUnboundStream;
  if (const char* what = defect(event)) {
    diagnostics_.warn(odometry != nullptr ? "malformed odometry" : "malformed scan",
                      "stream " + stream_names_[event.stream] + " at " + format_time(event.stamp) + " s",
                      what);
    return Outcome::kDroppedMalformed;
  }
  if (odometry != nullptr) return take(*odometry);
  return take(event.stream, std::get<std::shared_ptr<const LaserScan>>(event.payload));
}

Outcome MonteCarloLocalizer::take(const Odometry& odometry) {
  const OdometryBuffer::Intake intake = odometry_.offer(odometry);
  if (intake.held) settle_held(*intake.held);
  if (intake.set_back) {
    diagnostics_.warn("clock set back", "odometry at " + format_time(odometry.stamp) + " s",
                      "the stamps go on from here");
    if (belief_stamp_) belief_stamp_ = std::min(*belief_stamp_, odometry_.oldest());
  }
  return intake.now;
}

Outcome MonteCarloLocalizer::take(StreamId stream, const std::shared_ptr<const LaserScan>& scan) {
  if (belief_stamp_ && scan->stamp < *belief_stamp_) return Outcome::kDroppedOutOfOrder;
  const auto waits = [&](const PendingScan& p) { return p.stream == stream && p.scan->stamp == scan->stamp; };
  if (last_used_[stream] == scan->stamp || std::any_of(pending_.begin(), pending_.end(), waits)) {
    diagnostics_.warn("duplicate scan", "stream " + stream_names_[stream],
                      "two scans at " + format_time(scan->stamp) + " s");
    return Outcome::kDroppedOutOfOrder;
  }
  const auto later = std::upper_bound(pending_.begin(), pending_.end(), scan->stamp,
                                      [](Time t, const PendingScan& p) { return t < p.scan->stamp; });
  pending_.insert(later, {stream, scan, event_number_});
  return Outcome::kPending;
}

// Uses the scans around which the odometry is known, oldest first. Where too many wait, the latest goes: one
// from the future must not push out those that can still be used.
void MonteCarloLocalizer::use_pending() {
  while (!pending_.empty() && !odometry_.empty() && pending_.front().scan->stamp <= odometry_.newest()) {
    const PendingScan next = pending_.front();
    pending_.pop_front();
    const auto T_odom_base = odometry_.pose_at(next.scan->stamp);
    decide(next, T_odom_base ? use(next, *T_odom_base) : Outcome::kDroppedNoOdometry);
  }
  if (pending_.size() <= kMostPendingScans) return;
  const PendingScan latest = pending_.back();
  pending_.pop_back();
  decide(latest, Outcome::kDroppedNoOdometry);
}

void MonteCarloLocalizer::finish() {
  if (odometry_.drop_held()) settle_held(Outcome::kDroppedOutOfOrder);
  while (!pending_.empty()) {
    const PendingScan next = pending_.front();
    pending_.pop_front();
    const bool close =
        !odometry_.empty() && to_seconds(next.scan->stamp - odometry_.newest()) <= kExtrapolation_s;
    decide(next, close ? use(next, odometry_.newest_pose()) : Outcome::kDroppedNoOdometry);
  }
}

Outcome MonteCarloLocalizer::use(const PendingScan& pending, const Pose2& T_odom_base) {
  const LaserScan& scan = *pending.scan;
  const bool first = !belief_stamp_;
  const Pose2 T_last_now = first ? Pose2{} : between(T_odom_base_at_update_, T_odom_base);
  belief_stamp_ = scan.stamp;
  last_used_[pending.stream] = scan.stamp;
  odometry_.forget_before(scan.stamp);
  const bool update = first || moved_enough(T_last_now);
  if (update) {
    const LaserModels& models = laser_models_[pending.stream];
    if (global_start_) {
      start_anywhere(models.coarse->bind(scan));
    } else {
      filter_.update(T_last_now, (filter_.compact() ? models.fine : models.coarse)->bind(scan));
    }
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

Estimate MonteCarloLocalizer::summarize(const LaserScan& scan, const LaserModel& model) const {
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

void MonteCarloLocalizer::decide(const PendingScan& scan, Outcome outcome) {
  settle(scan.stream, outcome);
  if (scan.event_number == event_number_) event_outcome_ = outcome;
}

void MonteCarloLocalizer::settle_held(Outcome outcome) {
  settle(*odometry_stream_, outcome);
  if (outcome == Outcome::kUsed) return;
  diagnostics_.warn("odometry stamp not believed", "odometry after " + format_time(odometry_.newest()) + " s",
                    "its stamp jumps by more than 10 s, and the next message does not follow it");
}

void MonteCarloLocalizer::settle(StreamId stream, Outcome outcome) {
  --outcomes_[stream][static_cast<std::size_t>(Outcome::kPending)];
  count(stream, outcome);
}

void MonteCarloLocalizer::count(StreamId stream, Outcome outcome) {
  ++outcomes_[stream][static_cast<std::size_t>(outcome)];
}

}  // namespace cairn
