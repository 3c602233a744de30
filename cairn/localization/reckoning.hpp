#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/localization/stream_model.hpp"
#include "cairn/sensing/event.hpp"

#include <optional>

namespace cairn {

/// Where the robot would be if nothing but its motion had moved it over the last metres: what a pose that the
/// map moves is held against. A right pose is moved by as much as the odometry errs; one that is taken along
/// by a map which fits elsewhere, or has changed, is moved step by step, and what is seen speaks for each
/// step. How far the two have come apart is the drift.
///
/// The motion is that of the odometry, in steps of kStep_m, unless the scans at the ends of a step are closer
/// to each other (StreamModel::closeness) by the way that the pose has taken itself: then the odometry erred,
/// and the step is the pose's. A second account is kept in which wheels may have slipped, too: steps are
/// shorter than the odometry says where that fits the scans best. The account that is nearer to the pose
/// counts.
///
/// With every metre the reckoned position comes nearer to the believed one by a share of 1 -
/// e^(-1/kMemory_m), so that a constant error of the odometry of p % comes to p % of kMemory_m where no scan
/// corrects it. Poses are T_map_base.
class Reckoning {
 public:
  static constexpr double kStep_m = 0.4;           ///< 1 rad counts as 1 m
  static constexpr double kMemory_m = 5.0;         ///< way over which a disagreement is forgotten
  static constexpr double kHeadingMemory_m = 1.0;  ///< likewise one of heading; 1 rad counts as 1 m

  /// From here on, whatever was reckoned before.
  void begin(const Pose2& pose);
  /// Nothing is known of the motion: the next pose that is believed begins it.
  void forget() { known_ = false; }
  /// The odometry has moved the robot.
  void carry(const Pose2& T_before_after);
  /// A measurement was used, and the robot is believed there now. Returns the drift: the distance between the
  /// believed and the reckoned position, in metres.
  double observe(StreamId stream, const StreamModel& model, const Event::Payload& z, const Pose2& believed);

 private:
  struct Motions {
    Pose2 moved, slipped;
  };
  Motions motions(const StreamModel& model, const Event::Payload& z, const Pose2& believed) const;
  bool step_ends(bool comparable) const;

  struct Scan {
    StreamId stream;
    Event::Payload z;
  };
  bool known_ = false;
  Pose2 moved_, slipped_;     ///< the two accounts, where the step began
  Pose2 believed_;            ///< likewise
  std::optional<Scan> scan_;  ///< likewise; nullopt: none can be compared
  Pose2 T_step_;              ///< in the step, by the odometry
  double step_m_ = 0.0;
};

}  // namespace cairn
