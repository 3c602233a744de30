#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/core/time.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace cairn {

/// What a localizer believes at one instant.
struct Estimate {
  Time stamp;
  Pose2 T_map_base;                                      ///< mean of the heaviest hypothesis
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x, y, theta) in the map frame: m, rad
  double ess = 0.0;                                      ///< effective sample size of the last update
  int particles = 0;
  int hypotheses = 0;    ///< separate clusters of particles
  double weight = 0.0;   ///< share of the belief in the heaviest one
  double quality = 0.0;  ///< share of the last scan's beams that the map explains at T_map_base, 0..1
};

/// What became of a measurement. Every one ends in exactly one of these.
enum class Outcome : std::uint8_t {
  kUsed,                  ///< weighed the belief, or (odometry) moved it
  kNotNeeded,             ///< the robot had not moved enough since the last update
  kDroppedOutOfOrder,     ///< older than the belief
  kDroppedNoOdometry,     ///< no odometry around its stamp
  kDroppedMalformed,      ///< NaN, no beams, impossible geometry
  kDroppedUnboundStream,  ///< the configuration binds no model to its stream
  kPending,               ///< waits for odometry; never a final outcome
};
inline constexpr std::size_t kOutcomeCount = 7;
const char* to_string(Outcome outcome);

/// Number of measurements per outcome, for one stream.
using OutcomeCounts = std::array<std::int64_t, kOutcomeCount>;

/// A sample of the belief, for pictures: at most a few hundred particles.
struct ParticleSnapshot {
  Time stamp;
  std::vector<Pose2> particles;
};

}  // namespace cairn
