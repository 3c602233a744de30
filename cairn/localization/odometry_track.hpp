#pragma once

#include "cairn/localization/estimate.hpp"
#include "cairn/localization/pose_filter.hpp"
#include "cairn/localization/sliding_vector.hpp"
#include "cairn/sensing/odometry.hpp"

#include <optional>

namespace cairn {

/// Where the odometry saw the robot at one instant, remembered for the motion since then.
struct OdometryAnchor {
  Time stamp;
  Pose2 T_odom_base;
  bool known = false;  ///< false: no odometry around the stamp (yet), the pose is that of the nearest
};

/// The recent odometry, from which controls are cut at the exact stamps of the measurements (MuSe, sections
/// III-C and IV-B). What a cut leaves over is still there for the next one.
///
/// Messages may arrive late: they are put at their place as long as that is still kept. One wrong stamp must
/// not spoil the rest: a message more than kLargestJump from the newest one, ahead or behind, is held until
/// the next message says whether to believe it. A jump ahead is believed if the next message is later still
/// (a gap in the log), a jump back if the next one follows within kLargestJump (the robot's clock was set
/// back); otherwise the held message is dropped. The messages' own stamps are compared, not their arrival,
/// for many logs count the two from different zeros.
class OdometryTrack {
 public:
  static constexpr Duration kLargestJump = std::chrono::seconds(10);
  static constexpr std::size_t kMost = 100'000;  ///< older poses are forgotten: 16 min at 100 Hz

  /// What offer() did with a message, and with the one that was held before it.
  struct Intake {
    /// kUsed, kReplayed (put between earlier ones), kDroppedStale, kDroppedDuplicate, or kPending: it is held
    Outcome now = Outcome::kUsed;
    std::optional<Outcome> held;  ///< kUsed or kDroppedOutOfOrder; nullopt if none was held
    bool set_back = false;        ///< the clock was set back: the track starts anew at the held message
    /// Motions that begin or end after this stamp are no longer what they were; nullopt: none changed.
    std::optional<Time> changed_after;
  };
  Intake offer(const Odometry& odometry);

  /// Ends the input: forgets the held message. Returns whether there was one.
  bool drop_held();

  bool empty() const { return poses_.empty(); }
  Time oldest() const { return poses_.front().stamp; }      ///< @pre not empty
  const Odometry& newest() const { return poses_.back(); }  ///< @pre not empty

  /// T_odom_base at `stamp`, on the arc of constant twist between its neighbours; nullopt outside the track.
  std::optional<Pose2> pose_at(Time stamp) const;

  /// The anchor at `stamp`; beyond the track its nearest pose, not known. Without any odometry, the origin.
  OdometryAnchor anchor_at(Time stamp) const;

  /// The control from an anchor to `stamp`: motion as far as the odometry tells it, and the seconds for which
  /// it tells nothing.
  PoseControl control(const OdometryAnchor& from, Time stamp) const;

  /// Stamp of the newest pose that is not after `stamp`; of the oldest if all are. @pre not empty
  Time at_or_before(Time stamp) const;

  /// Drops what is not needed for stamps from `stamp` on.
  void forget_before(Time stamp);

 private:
  void believe(const Odometry& odometry, Intake& intake);
  Outcome take_or_hold(const Odometry& odometry, Intake& intake);
  std::size_t first_not_before(Time stamp) const;
  double unknown_s(const OdometryAnchor& from, Time to) const;

  SlidingVector<Odometry> poses_;
  std::optional<Odometry> held_;
  std::optional<Time> began_;  ///< stamp of the very first pose
  bool forgot_ = false;        ///< poses before the oldest were dropped
};

}  // namespace cairn
