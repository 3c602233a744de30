#pragma once

#include "cairn/core/relation.hpp"
#include "cairn/core/trajectory.hpp"

#include <span>
#include <vector>

namespace cairn {

/// Relative pose error: how wrong the motion between pairs of instants is (Kuemmerle et al., Autonomous
/// Robots 2009). It needs no alignment: it does not change when the whole estimate moves rigidly.
struct Rpe {
  std::size_t pairs = 0;
  std::size_t outside = 0;         ///< relations with an end outside the estimate's time span: not judged
  double translation_rms_m = 0.0;  ///< of |t|, where (t, r) = inverse(relation) * estimated motion
  double rotation_rms_rad = 0.0;   ///< of r
  double translation_max_m = 0.0;
  double rotation_max_rad = 0.0;
};

/// The estimate is interpolated at both ends of every relation, as in associate().
Rpe relative_pose_error(const Trajectory& estimate, std::span<const Relation> relations);

/// One relation per reference pose and the (interpolated) pose `delta` later, as far as the reference
/// reaches.
/// @throws ConfigurationError unless delta > 0.
std::vector<Relation> relations_over_time(const Trajectory& reference, Duration delta);

/// One relation per reference pose and the first pose at least `delta_m` of path later.
/// @throws ConfigurationError unless delta_m > 0.
std::vector<Relation> relations_over_distance(const Trajectory& reference, double delta_m);

}  // namespace cairn
