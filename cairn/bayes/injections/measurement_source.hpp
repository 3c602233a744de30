#pragma once

#include "cairn/bayes/injections/sample_from.hpp"

#include <memory>
#include <utility>

namespace cairn {

/// Samples of p(x | z) by the measurement's own model where it has that capability (BoundUpdate::sample),
/// else by another source.
template <class State>
class MeasurementSource final : public SampleFrom<State> {
 public:
  explicit MeasurementSource(std::unique_ptr<const SampleFrom<State>> otherwise)
      : otherwise_(std::move(otherwise)) {}

  void sample(const BoundUpdate<State>& z, std::span<State> states,
              const RandomStream& random) const override {
    z.sample ? z.sample(random, states) : otherwise_->sample(z, states, random);
  }

 private:
  std::unique_ptr<const SampleFrom<State>> otherwise_;
};

}  // namespace cairn
