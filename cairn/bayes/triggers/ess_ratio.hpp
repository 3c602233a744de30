#pragma once

#include "cairn/bayes/triggers/trigger.hpp"

namespace cairn {

/// When the effective sample size has fallen below a share of the particles (Liu & Chen, JASA 1998). Share 1:
/// unless all weights are equal; 0: never.
class EssRatio final : public Trigger {
 public:
  explicit EssRatio(double share) : share_(share) {}
  bool due(const SinceLast& since) const override { return since.ess < share_ * since.particles; }

 private:
  double share_;
};

}  // namespace cairn
