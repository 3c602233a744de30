#include "cairn/bayes/resampling/cumulative_weights.hpp"

#include "cairn/core/errors.hpp"

#include <cmath>

namespace cairn {

std::vector<double> cumulative_weights(std::span<const double> normalized_log_weights) {
  std::vector<double> cumulative;
  cumulative_weights(normalized_log_weights, cumulative);
  return cumulative;
}

void cumulative_weights(std::span<const double> normalized_log_weights, std::vector<double>& cumulative) {
  CAIRN_ASSERT(!normalized_log_weights.empty());
  cumulative.resize(normalized_log_weights.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < cumulative.size(); ++i)
    cumulative[i] = sum += std::exp(normalized_log_weights[i]);
  for (double& c : cumulative) c /= sum;
}

}  // namespace cairn
