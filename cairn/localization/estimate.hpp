#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/core/time.hpp"
#include "cairn/localization/judgement.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace cairn {

/// What a localizer believes at one instant: the mean of the heaviest hypothesis of its filter at the newest
/// measurement, carried on by the odometry.
struct Estimate {
  Time stamp;  ///< instant that the pose is of
  Pose2 T_map_base;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x, y, theta) in the map frame: m, rad
  double ess = 0.0;                                      ///< effective sample size of the last update
  int particles = 0;
  int hypotheses = 0;     ///< separate places: clusters of particles, and what a global search finds
  double weight = 0.0;    ///< share of the belief in the one that the pose is of
  double quality = 0.0;   ///< share of the last scan's beams that the map explains at T_map_base, 0..1
  Time belief_stamp{};    ///< of the newest measurement that the belief knows of: not after `stamp`
  Pose2 T_map_odom{};     ///< correction of the odometry: T_map_base = T_map_odom * T_odom_base
  Judgement judgement{};  ///< what the localizer thinks of it
};

/// A place where the robot may be: a group of particles that hangs together, or what a search has found.
struct Hypothesis {
  Pose2 T_map_base;                                      ///< mean of this group alone
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of this group alone: (x, y, theta), m, rad
  double weight = 0.0;                                   ///< share of the whole belief
  double age_s = 0.0;                                    ///< since it was first seen
  std::uint32_t id = 0;  ///< the same as long as it is followed; counted from 1 in one run
};

/// All places that the belief holds at one instant: those of the filter, the heaviest first, which is the
/// reported pose; behind them what a global search and a recovery hold possible. Those of no weight are left
/// out.
struct HypothesisSnapshot {
  Time stamp;
  std::vector<Hypothesis> hypotheses;
};

/// What became of a measurement. Every one ends in exactly one of these.
enum class Outcome : std::uint8_t {
  kUsed,                  ///< weighed the belief, or (odometry) moved it
  kReplayed,              ///< used, though it came late: put at its true time, and what followed done again
  kDeferred,              ///< used, after it had waited for computing time
  kNotNeeded,             ///< the robot had not moved enough since the last update, or the rate was reached
  kDroppedStale,          ///< older than the history reaches
  kDroppedOverBudget,     ///< waited for computing time until there was no more room or use for it
  kDroppedDuplicate,      ///< a second one of its stream with its stamp
  kDroppedOutOfOrder,     ///< odometry whose stamp is not believed
  kDroppedNoOdometry,     ///< stamped where the odometry never came
  kDroppedMalformed,      ///< NaN, no beams, impossible geometry
  kDroppedUnboundStream,  ///< the configuration binds no model to its stream
  kPending,               ///< waits for odometry or for computing time; never a final outcome
};
inline constexpr std::size_t kOutcomeCount = 12;
const char* to_string(Outcome outcome);

/// True for the outcomes that weigh the belief.
bool is_use(Outcome outcome);
/// True for the outcomes in which a message was lost.
bool is_drop(Outcome outcome);

/// Number of measurements per outcome, for one stream.
using OutcomeCounts = std::array<std::int64_t, kOutcomeCount>;

/// Share of the received messages that was lost (MuSe, section VI: dropped / received); 0 if none came.
double drop_rate(const OutcomeCounts& counts);

/// A sample of the belief, for pictures: at most a few hundred particles.
struct ParticleSnapshot {
  Time stamp;
  std::vector<Pose2> particles;
};

}  // namespace cairn
