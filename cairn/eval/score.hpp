#pragma once

#include "cairn/core/relation.hpp"
#include "cairn/eval/alignment.hpp"
#include "cairn/eval/ate.hpp"
#include "cairn/eval/lost.hpp"
#include "cairn/eval/rpe.hpp"

#include <string>

namespace cairn {

struct ScoreOptions {
  Alignment alignment = Alignment::kNone;
  /// The reference's body frame seen from the estimate's (for example base -> laser): applied to every
  /// estimate.
  Pose2 T_estimate_reference = {};
  /// What the relative error is judged by. Empty: motions of the reference over `rpe_delta_m`.
  std::vector<Relation> relations = {};
  double rpe_delta_m = 1.0;  ///< metres of path
  LostOptions lost = {};
};

/// All that is measured of one run.
struct Score {
  std::size_t reference_samples = 0;
  double coverage = 0.0;       ///< share of the reference samples inside the estimate's time span
  Pose2 T_reference_estimate;  ///< the alignment that was applied to the estimate; identity for none
  Ate ate;
  Rpe rpe;
  LostVerdict lost;
};

/// Scores an estimate against a reference, both in seconds of the same clock and (unless aligned) the same
/// map.
/// @throws InputError if no reference stamp lies in the estimate's time span.
Score score(const Trajectory& reference, const Trajectory& estimate, const ScoreOptions& options = {});

/// The figures as JSON, for scripts and metrics.json: metres and radians, names ending in their unit. The
/// errors of single samples are left out.
std::string to_json(const Score& score);

}  // namespace cairn
