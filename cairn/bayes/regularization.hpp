#pragma once

#include "cairn/bayes/filter_part.hpp"
#include "cairn/bayes/particle_set.hpp"
#include "cairn/core/rng.hpp"

#include <cstdint>
#include <span>

namespace cairn {

/// Spreads resampled particles a little, so that copies of one ancestor become different again (regularized
/// particle filter: Musso, Oudjane & Le Gland, in Sequential Monte Carlo Methods in Practice, 2001).
template <class State>
class Regularization : public FilterPart {
 public:
  /// Takes the width of the moves from the weighted particles. True if they are one compact group, which a
  /// measurement may enter in full; false if the belief is still spread over several places.
  virtual bool fit(const ParticleSet<State>& particles) = 0;

  /// Moves each state by its own random step; `draw` tells several moves within one step of the filter apart.
  virtual void move(std::span<State> states, const RandomStream& random, std::uint16_t draw) const = 0;
};

}  // namespace cairn
