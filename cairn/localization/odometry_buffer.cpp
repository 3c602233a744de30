#include "cairn/localization/odometry_buffer.hpp"

#include <algorithm>

namespace cairn {

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
