#pragma once

#include "cairn/core/trajectory.hpp"
#include "cairn/sensing/odometry.hpp"

#include <cstdint>
#include <vector>

namespace cairn {

/// Errors of two wheels with encoders (after Borenstein & Feng, "Measurement and correction of systematic
/// odometry errors in mobile robots", 1996). Systematic errors are drawn once for a seed: each wheel's radius
/// and the wheel base are wrong by a constant factor. Random errors: the rolled distance of each wheel gets
/// white noise whose variance grows with that distance.
struct WheelOdometryOptions {
  double wheel_base_m = 0.4;
  double sigma_wheel_radius = 0.003;      ///< relative, each wheel
  double sigma_wheel_base = 0.01;         ///< relative
  double sigma_per_sqrt_metre_m = 0.005;  ///< random error of one wheel after one metre
  int every = 2;                          ///< poses of the true trajectory per odometry message
};

/// What the robot's wheels tell of the true path: the first pose is the origin of the odometry frame, and
/// each stamp is that of a true pose.
/// @throws ConfigurationError for options out of range (negative sigmas, no wheel base, every < 1)
std::vector<Odometry> simulate_wheel_odometry(const Trajectory& truth, const WheelOdometryOptions& options,
                                              std::uint64_t seed);

}  // namespace cairn
