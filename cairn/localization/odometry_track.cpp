#include "cairn/localization/odometry_track.hpp"

#include <algorithm>

namespace cairn {

OdometryTrack::Intake OdometryTrack::offer(const Odometry& odometry) {
  Intake intake;
  if (held_) {
    const Odometry held = *held_;
    held_.reset();
    const bool ahead = held.stamp > newest().stamp;
    const bool later = odometry.stamp > held.stamp;
    const bool believed = later && (ahead || odometry.stamp - held.stamp <= kLargestJump);
    intake.held = believed ? Outcome::kUsed : Outcome::kDroppedOutOfOrder;
    intake.set_back = believed && !ahead;
    if (intake.set_back) *this = OdometryTrack();
    if (believed) believe(held, intake);
  }
  intake.now = take_or_hold(odometry, intake);
  return intake;
}

Outcome OdometryTrack::take_or_hold(const Odometry& odometry, Intake& intake) {
  const bool near = empty() || std::chrono::abs(odometry.stamp - newest().stamp) <= kLargestJump;
  if (!near) {
    held_ = odometry;
    return Outcome::kPending;
  }
  const std::size_t place = first_not_before(odometry.stamp);
  const bool last = place == poses_.size();
  if (!last && poses_[place].stamp == odometry.stamp) return Outcome::kDroppedDuplicate;
  if (place == 0 && forgot_) return Outcome::kDroppedStale;
  believe(odometry, intake);
  return last ? Outcome::kUsed : Outcome::kReplayed;
}

void OdometryTrack::believe(const Odometry& odometry, Intake& intake) {
  const std::size_t place = first_not_before(odometry.stamp);
  const Time changed = place == 0 ? Time::min() : poses_[place - 1].stamp;
  intake.changed_after = std::min(intake.changed_after.value_or(changed), changed);
  poses_.insert(place, odometry);
  began_ = std::min(began_.value_or(odometry.stamp), odometry.stamp);
  if (poses_.size() <= kMost) return;
  poses_.drop_front(1);
  forgot_ = true;
}

bool OdometryTrack::drop_held() {
  const bool held = held_.has_value();
  held_.reset();
  return held;
}

// Most questions are about the newest stamps.
std::size_t OdometryTrack::first_not_before(Time stamp) const {
  if (empty() || poses_.back().stamp < stamp) return poses_.size();
  const auto found = std::lower_bound(poses_.begin(), poses_.end(), stamp,
                                      [](const Odometry& o, Time t) { return o.stamp < t; });
  return static_cast<std::size_t>(found - poses_.begin());
}

std::optional<Pose2> OdometryTrack::pose_at(Time stamp) const {
  if (empty() || stamp < oldest() || stamp > newest().stamp) return std::nullopt;
  const std::size_t place = first_not_before(stamp);
  const Odometry& after = poses_[place];
  if (after.stamp == stamp) return after.T_odom_base;
  const Odometry& before = poses_[place - 1];
  const double fraction = to_seconds(stamp - before.stamp) / to_seconds(after.stamp - before.stamp);
  return interpolate(before.T_odom_base, after.T_odom_base, fraction);
}

OdometryAnchor OdometryTrack::anchor_at(Time stamp) const {
  if (empty()) return {stamp, {}, false};
  if (const auto pose = pose_at(stamp)) return {stamp, *pose, true};
  return {stamp, stamp < oldest() ? poses_.front().T_odom_base : newest().T_odom_base, false};
}

PoseControl OdometryTrack::control(const OdometryAnchor& from, Time stamp) const {
  // An anchor that was not known may be by now.
  const Pose2 T_odom_from = from.known ? from.T_odom_base : anchor_at(from.stamp).T_odom_base;
  return {between(T_odom_from, anchor_at(stamp).T_odom_base), unknown_s(from, stamp)};
}

double OdometryTrack::unknown_s(const OdometryAnchor& from, Time to) const {
  if (empty()) return to_seconds(to - from.stamp);
  const Time first = from.known ? from.stamp : *began_;
  const Duration before = std::max(std::min(to, first) - from.stamp, Duration{0});
  const Duration after = std::max(to - std::max(from.stamp, newest().stamp), Duration{0});
  return to_seconds(before + after);
}

Time OdometryTrack::at_or_before(Time stamp) const {
  const std::size_t place = first_not_before(stamp);
  const bool exact = place < poses_.size() && poses_[place].stamp == stamp;
  return poses_[exact || place == 0 ? place : place - 1].stamp;
}

void OdometryTrack::forget_before(Time stamp) {
  std::size_t count = 0;
  while (count + 1 < poses_.size() && poses_[count + 1].stamp <= stamp) ++count;
  if (count == 0) return;
  poses_.drop_front(count);
  forgot_ = true;
}

}  // namespace cairn
