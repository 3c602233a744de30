#pragma once

#include "cairn/bayes/filter_part.hpp"
#include "cairn/bayes/models.hpp"
#include "cairn/bayes/particle_set.hpp"
#include "cairn/core/executor.hpp"
#include "cairn/core/rng.hpp"

namespace cairn {

/// Improves the proposal: moves predicted particles to where a measurement wants them, before it weighs them
/// (corrective gradient refinement: Biswas, Coltin & Veloso, IROS 2011).
template <class State>
class Refinement : public FilterPart {
 public:
  /// Called before each correction, with the particles as predicted. Moves any of them, and adds to the
  /// log-weight of each the log of target density over proposal density; the weights need not stay
  /// normalised but must stay finite, and the number of particles must not change. The measurement itself
  /// weighs the particles afterwards, at their new places.
  /// @param random numbers of this correction: items and draws are all free
  virtual void refine(const BoundUpdate<State>& z, ParticleSet<State>& particles, const RandomStream& random,
                      const Executor& executor) = 0;
};

}  // namespace cairn
