#pragma once

#include "cairn/localization/estimate.hpp"
#include "cairn/sensing/odometry.hpp"

#include <deque>
#include <optional>

namespace cairn {

/// The recent odometry, from which controls are cut at the exact stamps of the measurements.
///
/// One wrong stamp must not spoil the rest: a message more than kLargestJump from the newest one, ahead or
/// behind, is held until the next message says whether to believe it. A jump ahead is believed if the next
/// message is later still (a gap in the log), a jump back if the next one follows within kLargestJump (the
/// robot's clock was set back); otherwise the held message is dropped. The messages' own stamps are compared,
/// not their arrival, for many logs count the two from different zeros.
class OdometryBuffer {
 public:
  static constexpr Duration kLargestJump = std::chrono::seconds(10);
  static constexpr std::size_t kMost = 100'000;  ///< older poses are forgotten: 16 min at 100 Hz

  /// What offer() did with a message, and with the one that was held before it.
  struct Intake {
    Outcome now = Outcome::kUsed;  ///< kUsed, kDroppedOutOfOrder, or kPending: it is held
    std::optional<Outcome> held;   ///< kUsed or kDroppedOutOfOrder; nullopt if none was held
    bool set_back = false;         ///< the clock was set back: the buffer starts anew at the held message
  };
  Intake offer(const Odometry& odometry);

  /// Ends the input: forgets the held message. Returns whether there was one.
  bool drop_held();

  bool empty() const { return poses_.empty(); }
  Time oldest() const { return poses_.front().stamp; }                    ///< @pre not empty
  Time newest() const { return poses_.back().stamp; }                     ///< @pre not empty
  const Pose2& newest_pose() const { return poses_.back().T_odom_base; }  ///< @pre not empty

  /// T_odom_base at `stamp`, on the arc of constant twist between its neighbours; nullopt outside the buffer.
  std::optional<Pose2> pose_at(Time stamp) const;

  /// Drops what is not needed for stamps from `stamp` on.
  void forget_before(Time stamp);

 private:
  void add(const Odometry& odometry);
  Outcome take_or_hold(const Odometry& odometry);

  std::deque<Odometry> poses_;
  std::optional<Odometry> held_;
};

}  // namespace cairn
