#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/core/time.hpp"

namespace cairn {

/// What is known of the motion between two instants, for example checked by a human or by a survey.
struct Relation {
  Time from;
  Time to;
  Pose2 T_from_to;  ///< the pose at `to`, seen from the pose at `from`
  friend bool operator==(const Relation&, const Relation&) = default;
};

}  // namespace cairn
