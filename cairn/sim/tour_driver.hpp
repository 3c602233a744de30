#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/core/time.hpp"
#include "cairn/core/trajectory.hpp"

#include <vector>

namespace cairn {

/// Limits of a differential-drive robot, and how often its true pose is told.
struct DriveLimits {
  double speed_mps = 0.9;
  double turn_rate_radps = 1.2;
  double acceleration_mps2 = 0.7;
  double turn_acceleration_radps2 = 2.5;
  Duration step = std::chrono::milliseconds(20);  ///< of the true trajectory
};

/// Drives from `start` to one waypoint after the other, and again from the first when the last is reached,
/// until `duration` is over; or, if `duration` is zero, once to the last. The robot turns on the spot where a
/// waypoint lies aside, slows down before it, and goes on when it is nearer than 10 cm; speeds change by no
/// more than the accelerations allow. Between two poses both speeds are constant: an arc.
/// @return poses from time zero, one per step; the first is `start`
/// @throws ConfigurationError without waypoints, with limits that are not positive, or if the waypoints
///   cannot be reached in a day
Trajectory drive_tour(const Pose2& start, const std::vector<Point2>& waypoints, const DriveLimits& limits,
                      Duration duration = Duration::zero());

}  // namespace cairn
