#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace cairn {

// The mixture of the beam model for many states at once, for the best instructions of the machine (see
// simd.hpp). BeamMixture is the oracle. Single precision: 1e-6 of a probability.

/// What all beams of a scan have in common; causes with their weights.
struct BeamCauses {
  float hit;        ///< z_hit / (sigma sqrt(2 pi)), 1/m
  float per_sigma;  ///< 1/m
  float lambda_per_m;
  float rand;         ///< z_rand / reach, 1/m
  float depth_m;      ///< how much farther than its front a wall is
  float max_range_m;  ///< from here on the map's ray meets nothing
};

/// Products of many probabilities, one per state: factor * 2^exponent.
struct BeamProducts {
  static constexpr std::size_t kCapacity = 64;
  alignas(64) std::array<float, kCapacity> factor;
  alignas(64) std::array<std::int32_t, kCapacity> exponent;

  void begin() { factor.fill(1.0f), exponent.fill(0); }
  double log(std::size_t i) const;
};

/// No factor of a product is smaller.
inline constexpr float kLeastProbability = 1e-15f;

/// Multiplies by p(z | r) of a beam with return, r the map's range of the front of the wall in each state.
/// @param unexpected z_short lambda exp(-lambda z)
/// @param ranges_m kCapacity of them
void multiply_return(const BeamCauses& causes, float z_m, float unexpected, const float* ranges_m,
                     BeamProducts& products);

/// Multiplies by kCapacity probabilities.
void multiply(const float* probabilities, BeamProducts& products);

}  // namespace cairn
