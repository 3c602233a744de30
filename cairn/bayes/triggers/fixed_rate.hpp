#pragma once

#include "cairn/bayes/triggers/trigger.hpp"

namespace cairn {

/// At the first measurement of every period, counted from time 0. Measurements every 0.1 s at a rate of 3 Hz
/// give 3 a second; waiting for a period to pass since the last one would give 2.5.
class FixedRate final : public Trigger {
 public:
  /// @param rate_hz > 0
  explicit FixedRate(double rate_hz) : rate_hz_(rate_hz) {}
  bool due(const SinceLast& since) const override { return period(since.now) > period(since.last); }

 private:
  double period(Time t) const { return std::floor(to_seconds(t) * rate_hz_); }

  double rate_hz_;
};

}  // namespace cairn
