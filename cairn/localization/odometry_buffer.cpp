#include "cairn/localization/odometry_buffer.hpp"

#include <algorithm>

namespace cairn {

OdometryBuffer::Intake OdometryBuffer::offer(const Odometry& odometry) {
  Intake intake;
  if (held_) {
    const Odometry held = *held_;
    held_.reset();
    const bool ahead = held.stamp > newest();
    const bool later = odometry.stamp > held.stamp;
    const bool believed = later && (ahead || odometry.stamp - held.stamp <= kLargestJump);
    intake.held = believed ? Outcome::kUsed : Outcome::kDroppedOutOfOrder;
    intake.set_back = believed && !ahead;
    if (intake.set_back) poses_.clear();
    if (believed) add(held);
  }
  intake.now = take_or_hold(odometry);
  return intake;
}

Outcome OdometryBuffer::take_or_hold(const Odometry& odometry) {
  const bool near = empty() || std::chrono::abs(odometry.stamp - newest()) <= kLargestJump;
  if (!near) {
    held_ = odometry;
    return Outcome::kPending;
  }
  if (!empty() && odometry.stamp <= newest()) return Outcome::kDroppedOutOfOrder;
  add(odometry);
  return Outcome::kUsed;
}

void OdometryBuffer::add(const Odometry& odometry) {
  poses_.push_back(odometry);
  if (poses_.size() > kMost) poses_.pop_front();
}

bool OdometryBuffer::drop_held() {
  const bool held = held_.has_value();
  held_.reset();
  return held;
}

std::optional<Pose2> OdometryBuffer::pose_at(Time stamp) const {
  if (empty() || stamp < oldest() || stamp > newest()) return std::nullopt;
  const auto after = std::lower_bound(poses_.begin(), poses_.end(), stamp,
                                      [](const Odometry& o, Time t) { return o.stamp < t; });
  if (after->stamp == stamp) return after->T_odom_base;
  const auto before = after - 1;
  const double fraction = to_seconds(stamp - before->stamp) / to_seconds(after->stamp - before->stamp);
  return interpolate(before->T_odom_base, after->T_odom_base, fraction);
}

void OdometryBuffer::forget_before(Time stamp) {
  while (poses_.size() > 1 && poses_[1].stamp <= stamp) poses_.pop_front();
}

}  // namespace cairn
