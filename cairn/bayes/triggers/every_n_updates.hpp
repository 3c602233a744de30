#pragma once

#include "cairn/bayes/triggers/trigger.hpp"

namespace cairn {

/// At every n-th measurement.
class EveryNUpdates final : public Trigger {
 public:
  explicit EveryNUpdates(std::int64_t n) : n_(n) {}
  bool due(const SinceLast& since) const override { return since.updates >= n_; }

 private:
  std::int64_t n_;
};

}  // namespace cairn
