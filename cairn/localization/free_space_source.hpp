#pragma once

#include "cairn/bayes/injections/sample_from.hpp"
#include "cairn/localization/global_start.hpp"

#include <memory>
#include <utility>

namespace cairn {

/// Samples of p(x | z) for whatever measurement: poses all over the free space of a map, weighed by it.
class FreeSpaceSource final : public SampleFrom<Pose2> {
 public:
  FreeSpaceSource(GlobalStart places, std::shared_ptr<const Executor> executor)
      : places_(std::move(places)), executor_(std::move(executor)) {}

  void sample(const BoundUpdate<Pose2>& z, std::span<Pose2> states,
              const RandomStream& random) const override {
    GlobalStart weighed = places_;
    weighed.weigh(z, *executor_);
    for (std::size_t i = 0; i < states.size(); ++i)
      states[i] = weighed.sample(random, static_cast<std::uint32_t>(i));
  }

 private:
  GlobalStart places_;
  std::shared_ptr<const Executor> executor_;
};

}  // namespace cairn
