#pragma once

#include "cairn/core/rng.hpp"
#include "cairn/core/time.hpp"

#include <functional>
#include <span>

namespace cairn {

/// p(x' | u, x): how a control moves a state. Implementations are immutable and may be called from several
/// threads at once.
template <class State, class Control>
class MotionModel {
 public:
  virtual ~MotionModel() = default;

  /// Replaces each state by a sample of its successor. `random` gives state i the numbers of item i.
  virtual void propagate(const Control& control, std::span<State> states,
                         const RandomStream& random) const = 0;
};

/// A measurement and its map, curried into a function of the states alone: what a filter needs to know of a
/// sensor. The function writes one log-likelihood per state (up to a constant that is the same for all
/// states); it is finite everywhere, and may be called from several threads at once.
template <class State>
struct BoundUpdate {
  using LogLikelihood = std::function<void(std::span<const State> states, std::span<double> out)>;
  Time stamp;
  LogLikelihood log_likelihood;
};

/// p(z | x): how likely a measurement is in each state of a batch. Implementations are immutable.
template <class State, class Measurement>
class SensorModel {
 public:
  virtual ~SensorModel() = default;

  /// Prepares one measurement for many states. The result keeps what it needs of `z` and of the model's map.
  virtual BoundUpdate<State> bind(const Measurement& z) const = 0;

  /// One log-likelihood per state. @pre out.size() == states.size()
  void log_likelihood(const Measurement& z, std::span<const State> states, std::span<double> out) const {
    bind(z).log_likelihood(states, out);
  }
};

}  // namespace cairn
