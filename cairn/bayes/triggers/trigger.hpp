#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/core/time.hpp"

#include <cmath>
#include <cstdint>

namespace cairn {

/// What has happened since something was last done.
struct SinceLast {
  Time last{};                 ///< stamp of the measurement when it was done
  Time now{};                  ///< stamp of the newest measurement
  std::int64_t updates = 0;    ///< measurements since, the newest among them
  double translation_m = 0.0;  ///< motion since
  double rotation_rad = 0.0;   ///< likewise, >= 0
  double ess = 0.0;            ///< effective sample size of the belief
  double particles = 0.0;      ///< their number

  void add_motion(const Pose2& T_before_after) {
    translation_m += std::hypot(T_before_after.x, T_before_after.y);
    rotation_rad += std::abs(T_before_after.theta);
  }
  /// Controls of any other kind tell no distance.
  template <class Control>
  void add_motion(const Control& /*u*/) {}
};

/// Decides whether it is time to do something again: to resample, to use a measurement.
///
/// A trigger remembers nothing: who asks it keeps the account of what has happened since, and begins a new
/// one when the trigger says that it is time.
class Trigger {
 public:
  virtual ~Trigger() = default;
  virtual bool due(const SinceLast& since) const = 0;
};

}  // namespace cairn
