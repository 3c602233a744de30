#pragma once

#include "cairn/bayes/resampling/cumulative_weights.hpp"
#include "cairn/bayes/resampling/resampling.hpp"
#include "cairn/core/statistics.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

namespace cairn::test {

/// Cumulative sums of weights that need not be normalised.
inline std::vector<double> cumulative_of(std::vector<double> weights) {
  for (double& w : weights) w = w > 0.0 ? std::log(w) : -1e300;
  normalize_log_weights(weights);
  return cumulative_weights(weights);
}

inline std::vector<std::uint32_t> drawn(Resampling& scheme, const std::vector<double>& cumulative,
                                        std::size_t count, std::uint64_t seed, std::uint64_t step = 0) {
  const RandomStream random(seed, RandomPurpose::kResample, step);
  std::vector<std::uint32_t> ancestors;
  scheme.draw(cumulative, count, DrawingNumbers(random, 0), ancestors);
  return ancestors;
}

/// How often each of `n` indices is among the ancestors.
inline std::vector<std::size_t> counts_of(const std::vector<std::uint32_t>& ancestors, std::size_t n) {
  std::vector<std::size_t> counts(n);
  for (const std::uint32_t a : ancestors) ++counts.at(a);
  return counts;
}

/// Weights of very different sizes.
inline std::vector<double> uneven_weights(std::size_t n, std::uint64_t seed) {
  const RandomStream random(seed, RandomPurpose::kTest, 0);
  std::vector<double> weights;
  for (std::uint32_t i = 0; i < n; ++i) weights.push_back(std::exp(1.5 * random.normal4(i)[0]));
  return weights;
}

}  // namespace cairn::test
