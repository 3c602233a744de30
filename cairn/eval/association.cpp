#include "cairn/eval/association.hpp"

namespace cairn {

std::vector<PosePair> associate(const Trajectory& reference, const Trajectory& estimate) {
  std::vector<PosePair> pairs;
  pairs.reserve(reference.size());
  for (const auto& [stamp, pose] : reference) {
    if (const auto estimated = pose_at(estimate, stamp)) pairs.push_back({stamp, pose, *estimated});
  }
  return pairs;
}

Trajectory move_in_own_frame(const Trajectory& trajectory, const Pose2& T_body_point) {
  Trajectory moved = trajectory;
  for (auto& sample : moved) sample.pose = sample.pose * T_body_point;
  return moved;
}

}  // namespace cairn
