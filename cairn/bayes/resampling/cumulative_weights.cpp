#include "cairn/bayes/resampling/cumulative_weights.hpp"

#include "cairn/core/batch_math.hpp"
#include "cairn/core/errors.hpp"

namespace cairn {

std::vector<double> cumulative_weights(std::span<const double> normalized_log_weights) {
  std::vector<double> cumulative;
  cumulative_weights(normalized_log_weights, cumulative);
  return cumulative;
}

void cumulative_weights(std::span<const double> normalized_log_weights, std::vector<double>& cumulative) {
  CAIRN_ASSERT(!normalized_log_weights.empty());
  cumulative.resize(normalized_log_weights.size());
  exp_all(normalized_log_weights, 0.0, cumulative);
  double sum = 0.0;
  for (double& c : cumulative) c = sum += c;
  for (double& c : cumulative) c /= sum;
}

}  // namespace cairn
