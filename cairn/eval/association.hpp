#pragma once

#include "cairn/core/trajectory.hpp"

#include <vector>

namespace cairn {

/// Where the reference and the estimate say the same frame was at one instant, both in the map (m, rad).
struct PosePair {
  Time stamp;
  Pose2 reference;
  Pose2 estimate;
};

/// One pair per reference stamp inside the time span of the estimate (ends included). The estimate is
/// interpolated: positions linear, heading along the shortest turn. Nothing is extrapolated: a reference
/// stamp outside the span makes no pair, so compare the number of pairs with the size of the reference.
std::vector<PosePair> associate(const Trajectory& reference, const Trajectory& estimate);

/// The trajectory of another point of the same body: every pose times `T_body_point`.
Trajectory move_in_own_frame(const Trajectory& trajectory, const Pose2& T_body_point);

}  // namespace cairn
