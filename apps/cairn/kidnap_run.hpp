#pragma once

#include "apps/cairn/localize_run.hpp"
#include "cairn/core/trajectory.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace cairn::app {

/// A recording whose robot's poses are known.
struct PosedLog {
  const Log* log = nullptr;  ///< sorted by stamp
  const Trajectory* reference = nullptr;
};

/// A robot that is carried away: driven along one recording up to `from`, it goes on in another (or the same)
/// from `to` on.
struct Kidnapping {
  Time from, to;
  double distance_m = 0.0;  ///< between the two places
};

struct KidnapOptions {
  double before_s = 20.0;         ///< driven before, from a pose near the true one
  double after_s = 20.0;          ///< and after
  double least_distance_m = 3.0;  ///< of the two places
  std::string odometry_stream;    ///< that has to go on; empty: the first
};

/// `count` kidnappings at random instants, both places in the reference; fewer if the recordings are short.
std::vector<Kidnapping> choose_kidnappings(const PosedLog& first, const PosedLog& second, int count,
                                           std::uint64_t seed, const KidnapOptions& options);

struct Splice {
  Log log;
  Trajectory reference;
  Time kidnapped;  ///< stamp of the last event before
};

/// Cuts and joins: the second part's stamps go on 0.1 s after the first's, its odometry from where that
/// ended.
Splice splice(const PosedLog& first, const PosedLog& second, const Kidnapping& kidnapping,
              const KidnapOptions& options);

/// An estimate against the truth.
struct JudgedEstimate {
  Estimate estimate;
  std::uint32_t place = 0;  ///< id of the believed hypothesis
  double weight = 0.0;      ///< of it among all, those beside the belief included
  double error_m = 0.0;
  double error_rad = 0.0;
  bool among = false;  ///< one of the hypotheses is within 1 m and 45 degrees of the truth
  bool right() const;  ///< within 1 m and 45 degrees
};

std::vector<JudgedEstimate> judge_run(const LocalizeResult& result, const Trajectory& reference);

/// What became of one kidnapping; times in seconds after it, negative: never.
struct KidnapOutcome {
  bool right_before = false;      ///< the pose was right when it happened
  double lost_after_s = -1.0;     ///< until the state was kLost
  double found_after_s = -1.0;    ///< until the pose was right and stayed so for kStays_s or to the end
  double sure_and_wrong_s = 0.0;  ///< after the first 2 s: wrong with a claimed probability above 0.95
  int false_alarms = 0;           ///< times that the state became kLost before, the pose being right
};
inline constexpr double kStays_s = 2.0;
KidnapOutcome judge_kidnapping(const std::vector<JudgedEstimate>& run, Time kidnapped);

}  // namespace cairn::app
