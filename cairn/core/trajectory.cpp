#include "cairn/core/trajectory.hpp"

#include "cairn/core/angle.hpp"

#include <algorithm>

namespace cairn {

std::size_t sort_by_stamp(Trajectory& trajectory) {
  std::stable_sort(trajectory.begin(), trajectory.end(),
                   [](const StampedPose& a, const StampedPose& b) { return a.stamp < b.stamp; });
  const auto same = [](const StampedPose& a, const StampedPose& b) { return a.stamp == b.stamp; };
  const auto end = std::unique(trajectory.begin(), trajectory.end(), same);
  const auto dropped = static_cast<std::size_t>(trajectory.end() - end);
  trajectory.erase(end, trajectory.end());
  return dropped;
}

std::optional<Pose2> pose_at(const Trajectory& trajectory, Time stamp) {
  const auto after = std::lower_bound(trajectory.begin(), trajectory.end(), stamp,
                                      [](const StampedPose& p, Time t) { return p.stamp < t; });
  if (after == trajectory.end()) return std::nullopt;
  if (after->stamp == stamp) return after->pose;
  if (after == trajectory.begin()) return std::nullopt;
  const StampedPose& a = *(after - 1);
  const StampedPose& b = *after;
  const double f = to_seconds(stamp - a.stamp) / to_seconds(b.stamp - a.stamp);
  return Pose2{a.pose.x + f * (b.pose.x - a.pose.x), a.pose.y + f * (b.pose.y - a.pose.y),
               interpolate_angle(a.pose.theta, b.pose.theta, f)};
}

double path_length(const Trajectory& trajectory) {
  double length = 0.0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    length += distance(trajectory[i - 1].pose, trajectory[i].pose);
  }
  return length;
}

}  // namespace cairn
