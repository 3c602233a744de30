#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/core/time.hpp"

namespace cairn {

/// Pose of the robot's base in the odometry frame, which drifts but never jumps.
struct Odometry {
  Time stamp;
  Pose2 T_odom_base;
};

}  // namespace cairn
