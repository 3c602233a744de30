#include "apps/cairn/kidnap_run.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/rng.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <type_traits>
#include <variant>

namespace cairn::app {
namespace {

constexpr double kRight_m = 1.0;
constexpr double kRight_rad = std::numbers::pi / 4.0;
constexpr double kGap_s = 0.1;
constexpr int kMostTries = 1000;
constexpr double kSure = 0.95;
constexpr double kAllowance_s = 2.0;

Trajectory odometry_of(const Log& log, const std::string& wanted) {
  Trajectory odometry;
  std::optional<StreamId> stream;
  for (const Event& event : log.events) {
    const auto* o = std::get_if<Odometry>(&event.payload);
    if (o == nullptr || (!wanted.empty() && log.streams[event.stream].name != wanted)) continue;
    if (stream.value_or(event.stream) != event.stream) continue;
    stream = event.stream;
    odometry.push_back({o->stamp, o->T_odom_base});
  }
  sort_by_stamp(odometry);
  return odometry;
}

// Moved in time, and the odometry into another frame.
Event moved(const Event& event, Duration later, const Pose2& T_new_old) {
  Event copy = event;
  copy.stamp += later;
  copy.arrival += later;
  std::visit(
      [&](auto& payload) {
        if constexpr (requires { *payload; }) {
          if (!payload) return;
          auto own = *payload;
          own.stamp += later;
          payload = std::make_shared<const decltype(own)>(std::move(own));
        } else {
          payload.stamp += later;
        }
      },
      copy.payload);
  if (auto* odometry = std::get_if<Odometry>(&copy.payload))
    odometry->T_odom_base = T_new_old * odometry->T_odom_base;
  return copy;
}

bool inside(const PosedLog& run, Time from, Time to) {
  return !run.reference->empty() && from >= run.reference->front().stamp &&
         to <= run.reference->back().stamp && from >= run.log->events.front().stamp &&
         to <= run.log->events.back().stamp;
}

Time random_instant(const PosedLog& run, double u) {
  const Time first = run.reference->front().stamp;
  const double span_s = to_seconds(run.reference->back().stamp - first);
  return first + duration_from_seconds(u * span_s);
}

bool is_right(double error_m, double error_rad) { return error_m < kRight_m && error_rad < kRight_rad; }

double turned_by(const Pose2& a, const Pose2& b) { return std::abs(normalize_angle(a.theta - b.theta)); }

}  // namespace

std::vector<Kidnapping> choose_kidnappings(const PosedLog& first, const PosedLog& second, int count,
                                           std::uint64_t seed, const KidnapOptions& options) {
  const RandomStream random(seed, RandomPurpose::kCandidates, 0);
  const Duration before = duration_from_seconds(options.before_s);
  const Duration after = duration_from_seconds(options.after_s);
  std::vector<Kidnapping> chosen;
  for (int i = 0; i < kMostTries * count && chosen.size() < static_cast<std::size_t>(count); ++i) {
    const auto u = random.uniform4(static_cast<std::uint32_t>(i));
    Kidnapping k{random_instant(first, u[0]), random_instant(second, u[1])};
    if (!inside(first, k.from - before, k.from) || !inside(second, k.to, k.to + after)) continue;
    k.distance_m = distance(*pose_at(*first.reference, k.from), *pose_at(*second.reference, k.to));
    if (k.distance_m >= options.least_distance_m) chosen.push_back(k);
  }
  return chosen;
}

Splice splice(const PosedLog& first, const PosedLog& second, const Kidnapping& kidnapping,
              const KidnapOptions& options) {
  Splice joined;
  joined.log.streams = first.log->streams;
  joined.log.format = first.log->format;
  joined.kidnapped = kidnapping.from;
  const Time begin = kidnapping.from - duration_from_seconds(options.before_s);
  const Time end = kidnapping.to + duration_from_seconds(options.after_s);
  for (const Event& event : first.log->events) {
    if (event.stamp >= begin && event.stamp <= kidnapping.from) joined.log.events.push_back(event);
  }
  for (const StampedPose& p : *first.reference) {
    if (p.stamp >= begin && p.stamp <= kidnapping.from) joined.reference.push_back(p);
  }
  const Duration later = kidnapping.from + duration_from_seconds(kGap_s) - kidnapping.to;
  const auto at_from = pose_at(odometry_of(*first.log, options.odometry_stream), kidnapping.from);
  const auto at_to = pose_at(odometry_of(*second.log, options.odometry_stream), kidnapping.to);
  const Pose2 T_new_old = at_from && at_to ? *at_from * inverse(*at_to) : Pose2{};
  for (const Event& event : second.log->events) {
    if (event.stamp >= kidnapping.to && event.stamp <= end)
      joined.log.events.push_back(moved(event, later, T_new_old));
  }
  for (const StampedPose& p : *second.reference) {
    if (p.stamp >= kidnapping.to && p.stamp <= end) joined.reference.push_back({p.stamp + later, p.pose});
  }
  return joined;
}

bool JudgedEstimate::right() const { return is_right(error_m, error_rad); }

std::vector<JudgedEstimate> judge_run(const LocalizeResult& result, const Trajectory& reference) {
  std::vector<JudgedEstimate> run;
  for (std::size_t i = 0; i < result.estimates.size(); ++i) {
    const Estimate& estimate = result.estimates[i];
    const auto truth = pose_at(reference, estimate.stamp);
    if (!truth) continue;
    const auto& places = result.hypotheses[i].hypotheses;
    const bool among = std::any_of(places.begin(), places.end(), [&](const Hypothesis& place) {
      return is_right(distance(place.T_map_base, *truth), turned_by(place.T_map_base, *truth));
    });
    run.push_back({estimate, places.empty() ? 0 : places.front().id,
                   places.empty() ? 0.0 : places.front().weight, distance(estimate.T_map_base, *truth),
                   turned_by(estimate.T_map_base, *truth), among});
  }
  return run;
}

KidnapOutcome judge_kidnapping(const std::vector<JudgedEstimate>& run, Time kidnapped) {
  KidnapOutcome outcome;
  bool lost_before = false;
  Time right_since{};
  bool right = false;
  for (std::size_t i = 0; i < run.size(); ++i) {
    const JudgedEstimate& now = run[i];
    const bool lost = now.estimate.judgement.state == TrackingState::kLost;
    const double after_s = to_seconds(now.estimate.stamp - kidnapped);
    if (after_s <= 0.0) {
      outcome.right_before = now.right();
      outcome.false_alarms += lost && !lost_before && now.right() ? 1 : 0;
      lost_before = lost;
      continue;
    }
    if (lost && outcome.lost_after_s < 0.0) outcome.lost_after_s = after_s;
    if (now.right() && !right) right_since = now.estimate.stamp;
    right = now.right();
    const bool stays =
        right && (to_seconds(now.estimate.stamp - right_since) >= kStays_s || i + 1 == run.size());
    if (stays && outcome.found_after_s < 0.0) outcome.found_after_s = to_seconds(right_since - kidnapped);
    const bool sure_and_wrong =
        !right && now.estimate.judgement.probability > kSure && after_s > kAllowance_s;
    if (sure_and_wrong && i > 0)
      outcome.sure_and_wrong_s += to_seconds(now.estimate.stamp - run[i - 1].estimate.stamp);
  }
  return outcome;
}

}  // namespace cairn::app
