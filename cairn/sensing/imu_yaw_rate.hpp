#pragma once

#include "cairn/core/time.hpp"

namespace cairn {

/// Rate of turn of the robot about the vertical, as a gyroscope tells it: with its bias.
struct ImuYawRate {
  Time stamp;
  double yaw_rate_radps = 0.0;  ///< counter-clockwise
};

}  // namespace cairn
