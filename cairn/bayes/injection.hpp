#pragma once

#include "cairn/bayes/filter_part.hpp"
#include "cairn/bayes/models.hpp"
#include "cairn/core/rng.hpp"

#include <cstddef>
#include <span>

namespace cairn {

/// Brings particles from elsewhere into a belief that is surely wrong (a kidnapped robot): anywhere
/// (augmented MCL: Thrun et al., Probabilistic Robotics, table 8.3) or where the measurement says (sensor
/// resetting: Lenser & Veloso, ICRA 2000).
template <class State>
class Injection : public FilterPart {
 public:
  /// How many of `particles` particles to replace after a measurement, 0 to `particles`.
  /// Called once after each correction.
  /// @param log_mean_likelihood log of the unnormalised likelihood's mean per particle, under the belief
  ///   before the measurement. Comparable between measurements of one sensor only.
  virtual std::size_t wanted(const BoundUpdate<State>& z, double log_mean_likelihood,
                             std::size_t particles) = 0;

  /// Fills `states` with samples that do not depend on the belief.
  /// @param random numbers of this injection: items and draws are all free
  virtual void sample(const BoundUpdate<State>& z, std::span<State> states,
                      const RandomStream& random) const = 0;
};

}  // namespace cairn
