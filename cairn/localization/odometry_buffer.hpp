#pragma once

#include "cairn/sensing/odometry.hpp"

#include <deque>
#include <optional>

namespace cairn {

/// The recent odometry, from which controls are cut at the exact stamps of the measurements.
class OdometryBuffer {
 public:
  /// @pre newer than the newest
  void add(const Odometry& odometry) { poses_.push_back(odometry); }

  bool empty() const { return poses_.empty(); }
  Time oldest() const { return poses_.front().stamp; }
  Time newest() const { return poses_.back().stamp; }
  const Pose2& newest_pose() const { return poses_.back().T_odom_base; }

  /// T_odom_base at `stamp`, on the arc of constant twist between its neighbours; nullopt outside the buffer.
  std::optional<Pose2> pose_at(Time stamp) const;

  /// Drops what is not needed for stamps from `stamp` on.
  void forget_before(Time stamp);

 private:
  std::deque<Odometry> poses_;
};

}  // namespace cairn
