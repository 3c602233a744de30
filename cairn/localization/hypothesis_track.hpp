#pragma once

#include "cairn/bayes/hypotheses.hpp"
#include "cairn/core/pose2.hpp"
#include "cairn/core/time.hpp"
#include "cairn/localization/estimate.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace cairn {

/// How near a place has to be to one of before, carried on by the odometry, to count as the same.
struct SamePlace {
  double within_m = 1.5;
  double within_rad = 0.5;
};

/// The places of a belief, followed from update to update.
struct HypothesisTrack {
  std::vector<Hypothesis> places;  ///< at the last update, the believed one first
  std::uint32_t last_id = 0;

  /// Of the believed place; 0 before the first update.
  std::uint32_t believed() const { return places.empty() ? 0 : places.front().id; }
};

/// Follows hypotheses from update to update: gives each the age of the one that it continues. Heavier ones
/// choose first, each the nearest of those that nobody has chosen; what continues nothing is new.
/// @param track those of the last update, at its stamp; its places become `found`
/// @param T_before_after how the robot moved since
/// @param since seconds since the last update
void follow_hypotheses(std::span<const PoseHypothesis> found, const Pose2& T_before_after, double since_s,
                       const SamePlace& same, HypothesisTrack& track, std::vector<Hypothesis>& scratch);

}  // namespace cairn
