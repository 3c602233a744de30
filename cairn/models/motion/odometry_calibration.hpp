#pragma once

#include "cairn/core/trajectory.hpp"
#include "cairn/models/motion/differential_drive.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace cairn {

/// One motion as the wheels told it and as it was, both T_before_after in the robot's own frame.
struct MotionPair {
  Pose2 told;
  Pose2 truth;
};

/// A drive without gaps, cut into motions that follow each other.
using MotionChain = std::vector<MotionPair>;

struct MotionCutting {
  double step_m = 0.1;    ///< a motion ends when the odometry has gone this far ...
  double step_rad = 0.1;  ///< ... or turned this much (as UpdateOptions: the filter's own steps)
  Duration max_gap = std::chrono::seconds(1);  ///< nothing is interpolated between poses further apart
};

/// Cuts odometry and reference at the stamps of the odometry. A chain ends where either has a gap, or the
/// reference does.
/// @throws ConfigurationError for steps that are not positive
std::vector<MotionChain> cut_motions(const Trajectory& odometry, const Trajectory& reference,
                                     const MotionCutting& options);

/// A value and its standard error.
struct Estimated {
  double value = 0.0;
  double error = 0.0;
};

/// What the differences between odometry and reference tell of the wheels (as WorldOdometryOptions has them)
/// and of the noise that a filter is to expect (as DifferentialDriveOptions has it).
struct OdometryCalibration {
  std::size_t motions = 0;
  double way_m = 0.0;

  // Systematic: told = factor * true. The turn also has a part that grows with the distance.
  Estimated distance_factor;
  Estimated turn_factor;
  Estimated drift_rad_per_m;

  // Random, after the systematic part is taken off: the variance grows with the way (distance, and half the
  // wheel base times the angle turned), as that of a random walk.
  Estimated sigma_per_sqrt_metre_m;
  Estimated sigma_per_sqrt_metre_rad;
  /// What does not grow with the way: noise of the reference at both ends of a motion, and jitter of the
  /// odometry.
  Estimated sigma_constant_m;
  Estimated sigma_constant_rad;
  /// Share of the motions that err with five times the deviation: slips, bumps, jumps of the reference.
  double outlier_share = 0.0;

  /// Of the filter's motion model for steps of this length; the alphas multiply squares, so that they belong
  /// to the length of a step. They cover the systematic errors too, which no filter takes off.
  Estimated alpha1, alpha2, alpha3, alpha4;

  DifferentialDriveOptions motion_options() const;
};

struct OdometryCalibrationOptions {
  double wheel_base_m = 0.4;  ///< an assumption: what is told twice as wide turns half as much
  int resamples = 100;        ///< of the bootstrap that gives the standard errors
  std::uint64_t seed = 1;
};

/// Learns both by robust maximum likelihood (fit_variance_components). Systematic errors are fitted to
/// stretches of eight motions; the growing and the constant part of the noise are told apart by stretches of
/// one, two, four and eight motions (cf. Borenstein & Feng, "Measurement and correction of systematic
/// odometry errors in mobile robots", 1996; Martinelli, "The odometry error of a mobile robot with a
/// synchronous drive system", 2002). Standard errors come from a bootstrap of blocks of 32 motions: noise
/// that lasts less long is accounted for.
/// @throws InputError for fewer than 64 motions; ConfigurationError for a wheel base that is not positive
OdometryCalibration calibrate_odometry(std::span<const MotionChain> chains,
                                       const OdometryCalibrationOptions& options = {});

}  // namespace cairn
