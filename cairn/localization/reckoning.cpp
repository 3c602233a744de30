#include "cairn/localization/reckoning.hpp"

#include "cairn/core/angle.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kCloser = 0.02;  // so much closer the scans have to be by another motion than the odometry's
constexpr double kClose = 0.97;   // closer ones leave nothing to explain
constexpr double kSlips[] = {0.8, 0.6, 0.4, 0.2, 0.0};  // shares of its motion that slipping wheels leave

Pose2 shortened(const Pose2& motion, double share) {
  return {share * motion.x, share * motion.y, motion.theta};
}

// Of an account that began the step at `reckoned`.
Pose2 advance(const Pose2& reckoned, const Pose2& motion, const Pose2& believed) {
  const double way_m = std::hypot(motion.x, motion.y);
  const double turn = std::abs(normalize_angle(motion.theta));
  const double forgotten = -std::expm1(-way_m / Reckoning::kMemory_m);
  const double turn_forgotten = -std::expm1(-(way_m + turn) / Reckoning::kHeadingMemory_m);
  const Pose2 there = reckoned * motion;
  return {there.x + forgotten * (believed.x - there.x), there.y + forgotten * (believed.y - there.y),
          normalize_angle(there.theta + turn_forgotten * normalize_angle(believed.theta - there.theta))};
}

}  // namespace

void Reckoning::begin(const Pose2& pose) {
  known_ = true;
  moved_ = slipped_ = believed_ = pose;
  scan_.reset();
  T_step_ = {};
  step_m_ = 0.0;
}

void Reckoning::carry(const Pose2& T_before_after) {
  T_step_ = T_step_ * T_before_after;
  step_m_ += std::hypot(T_before_after.x, T_before_after.y) + std::abs(normalize_angle(T_before_after.theta));
}

// A scanner that falls silent ends no step of its own.
bool Reckoning::step_ends(bool comparable) const {
  return !scan_ || step_m_ >= (comparable ? kStep_m : 2.0 * kStep_m);
}

Reckoning::Motions Reckoning::motions(const StreamModel& model, const Event::Payload& z,
                                      const Pose2& believed) const {
  Motions best{T_step_, T_step_};
  const auto closeness = [&](const Pose2& motion) { return model.closeness(scan_->z, z, motion); };
  const std::optional<double> by_odometry = closeness(T_step_);
  if (!by_odometry || *by_odometry >= kClose) return best;
  double closest = *by_odometry + kCloser;
  const auto try_out = [&](const Pose2& motion) {
    const double c = closeness(motion).value_or(0.0);
    if (c <= closest) return false;
    closest = c;
    best.slipped = motion;
    return true;
  };
  const Pose2 as_believed = inverse(believed_) * believed;
  if (try_out(as_believed)) best.moved = as_believed;
  for (const double share : kSlips) {
    if (closest < kClose) try_out(shortened(T_step_, share));
  }
  return best;
}

double Reckoning::observe(StreamId stream, const StreamModel& model, const Event::Payload& z,
                          const Pose2& believed) {
  if (!known_) begin(believed);
  const bool can_compare = model.can_compare(z);
  const bool comparable = scan_ && scan_->stream == stream && can_compare;
  if (step_ends(comparable)) {
    const Motions step = comparable ? motions(model, z, believed) : Motions{T_step_, T_step_};
    const Pose2 moved = advance(moved_, step.moved, believed);
    const Pose2 slipped = advance(slipped_, step.slipped, believed);
    begin(believed);
    moved_ = moved;
    slipped_ = slipped;
    if (can_compare) scan_ = Scan{stream, z};
  }
  return std::min(distance(moved_ * T_step_, believed), distance(slipped_ * T_step_, believed));
}

}  // namespace cairn
