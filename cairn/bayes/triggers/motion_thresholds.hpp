#pragma once

#include "cairn/bayes/triggers/trigger.hpp"

namespace cairn {

/// After so much driving, or so much turning: a robot that stands learns nothing new from the same view.
class MotionThresholds final : public Trigger {
 public:
  MotionThresholds(double translation_m, double rotation_rad)
      : translation_m_(translation_m), rotation_rad_(rotation_rad) {}
  bool due(const SinceLast& since) const override {
    return since.translation_m >= translation_m_ || since.rotation_rad >= rotation_rad_;
  }

 private:
  double translation_m_;
  double rotation_rad_;
};

}  // namespace cairn
