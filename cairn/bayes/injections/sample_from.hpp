#pragma once

#include "cairn/bayes/models.hpp"
#include "cairn/core/rng.hpp"

#include <span>

namespace cairn {

/// Capability: samples of p(x | z) for one measurement, without any belief.
template <class State>
class SampleFrom {
 public:
  virtual ~SampleFrom() = default;
  virtual void sample(const BoundUpdate<State>& z, std::span<State> states,
                      const RandomStream& random) const = 0;
};

}  // namespace cairn
