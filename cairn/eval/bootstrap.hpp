#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace cairn {

struct BootstrapOptions {
  int resamples = 10'000;
  double level = 0.95;     ///< of the interval, within (0, 1)
  std::uint64_t seed = 1;  ///< the same values, options and seed give the same bytes

  void validate() const;  ///< @throws ConfigurationError
};

/// Mean of a sample and where the mean of the population may lie.
struct MeanInterval {
  std::size_t count = 0;
  double mean = 0.0;  ///< NaN for no values
  double low = 0.0;   ///< NaN for fewer than two values: one tells nothing of the spread
  double high = 0.0;
};

/// Percentile bootstrap of the mean (Efron & Tibshirani, "An Introduction to the Bootstrap", 1993, ch. 13):
/// the sample is drawn from itself, with replacement; the interval holds the middle `level` of the means.
/// With few values it is somewhat too short (ten normal values: 95 % is in truth about 90 %).
MeanInterval bootstrap_mean(std::span<const double> values, const BootstrapOptions& options = {});

}  // namespace cairn
