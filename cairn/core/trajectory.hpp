#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/core/time.hpp"

#include <optional>
#include <vector>

namespace cairn {

struct StampedPose {
  Time stamp;
  Pose2 pose;
  friend bool operator==(const StampedPose&, const StampedPose&) = default;
};

/// Poses of one frame over time, in the order of their stamps (strictly increasing).
using Trajectory = std::vector<StampedPose>;

/// Sorts by stamp (stable) and keeps the first of equal stamps. Returns how many poses were dropped.
std::size_t sort_by_stamp(Trajectory& trajectory);

/// Pose at `stamp`: positions linear, heading along the shortest turn. nullopt outside the time span.
std::optional<Pose2> pose_at(const Trajectory& trajectory, Time stamp);

/// Length of the path, metres.
double path_length(const Trajectory& trajectory);

}  // namespace cairn
