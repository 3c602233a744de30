#include "cairn/bayes/weights.hpp"

#include "cairn/core/batch_math.hpp"
#include "cairn/core/errors.hpp"

#include <cmath>

namespace cairn {

double normalize_weights(std::span<double> log_weights, std::vector<double>& weights) {
  CAIRN_ASSERT(!log_weights.empty());
  const double largest = largest_of(log_weights);
  weights.resize(log_weights.size());
  exp_all(log_weights, -largest, weights);
  const double sum = sum_of(weights), squares = sum_of_squares(weights);
  const double log_sum = largest + std::log(sum), scale = 1.0 / sum;
  for (double& w : log_weights) w -= log_sum;
  for (double& w : weights) w *= scale;
  return sum * sum / squares;
}

}  // namespace cairn
