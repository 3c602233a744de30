#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/core/rng.hpp"
#include "cairn/core/time.hpp"

#include <cstdint>
#include <functional>
#include <span>

#include <Eigen/Core>

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

/// Derivative of a number with respect to a state.
template <class State>
struct GradientOf {
  using Type = State;
};
template <>
struct GradientOf<Pose2> {
  using Type = Eigen::Vector3d;  ///< per x, y (metres, map frame) and heading (radians)
};

/// A measurement and its map, curried into functions of the states alone: what a filter needs to know of a
/// sensor. All of them may be called from several threads at once.
template <class State>
struct BoundUpdate {
  using LogLikelihood = std::function<void(std::span<const State> states, std::span<double> out)>;
  using Gradient =
      std::function<void(std::span<const State> states, std::span<typename GradientOf<State>::Type> out)>;
  using Sample = std::function<void(const RandomStream& random, std::span<State> out)>;

  Time stamp;
  /// Writes one log-likelihood per state (up to a constant that is the same for all states), finite
  /// everywhere.
  LogLikelihood log_likelihood;
  /// Writes the derivative of that log-likelihood per state, finite everywhere. Empty if the model has none.
  Gradient gradient = {};
  /// Draws states from p(x | z), state i with the numbers of item i. Empty if the model cannot.
  Sample sample = {};
  /// Tells the sensors apart, for parts of a filter that keep averages per sensor.
  std::uint32_t stream = 0;
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
