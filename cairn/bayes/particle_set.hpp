#pragma once

#include <vector>

namespace cairn {

/// Weighted samples of a belief. The weights are kept as logs and are normalised between the steps of a
/// filter.
template <class State>
struct ParticleSet {
  std::vector<State> states;
  std::vector<double> log_weights;
  /// The exponentials of log_weights, where a filter keeps them (see ParticleFilter); else empty.
  std::vector<double> weights = {};

  std::size_t size() const { return states.size(); }
};

}  // namespace cairn
