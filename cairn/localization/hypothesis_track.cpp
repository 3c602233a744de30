#include "cairn/localization/hypothesis_track.hpp"

#include "cairn/core/angle.hpp"

#include <cmath>
#include <limits>

namespace cairn {
namespace {

constexpr double kTaken = -1.0;  // age of one that was continued

// The nearest free one; nullptr if none is near enough.
Hypothesis* nearest(std::vector<Hypothesis>& before, const Pose2& T_before_after, const Pose2& now,
                    const SamePlace& same) {
  Hypothesis* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (Hypothesis& old : before) {
    const Pose2 carried = old.T_map_base * T_before_after;
    const double apart_m = distance(carried, now);
    const double turned = std::abs(normalize_angle(carried.theta - now.theta));
    if (old.age_s == kTaken || apart_m > same.within_m || turned > same.within_rad) continue;
    const double far = apart_m / same.within_m + turned / same.within_rad;
    if (far < least) least = far, best = &old;
  }
  return best;
}

}  // namespace

void follow_hypotheses(std::span<const PoseHypothesis> found, const Pose2& T_before_after, double since_s,
                       const SamePlace& same, HypothesisTrack& track, std::vector<Hypothesis>& scratch) {
  scratch.clear();
  for (const PoseHypothesis& now : found) {
    Hypothesis* old = nearest(track.places, T_before_after, now.mean, same);
    const double age_s = old != nullptr ? old->age_s + since_s : 0.0;
    const std::uint32_t id = old != nullptr ? old->id : ++track.last_id;
    if (old != nullptr) old->age_s = kTaken;
    scratch.push_back({now.mean, now.covariance, now.weight, age_s, id});
  }
  std::swap(track.places, scratch);
}

}  // namespace cairn
