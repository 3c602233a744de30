#include "cairn/bayes/tempering.hpp"

#include "cairn/core/batch_math.hpp"
#include "cairn/core/errors.hpp"

#include <cmath>

namespace cairn {
namespace {

constexpr double kSmallestExponent = 1e-4;

// (sum w)^2 / sum w^2 with w = exp(prior + exponent * likelihood).
double tempered_ess(std::span<const double> priors, std::span<const double> likelihoods, double exponent,
                    std::vector<double>& scratch) {
  for (std::size_t i = 0; i < scratch.size(); ++i) scratch[i] = priors[i] + exponent * likelihoods[i];
  const double largest = largest_of(scratch);
  exp_all(scratch, -largest, scratch);
  const double sum = sum_of(scratch);
  return sum * sum / sum_of_squares(scratch);
}

}  // namespace

double tempering_exponent(std::span<const double> log_priors, std::span<const double> log_likelihoods,
                          double min_ess, double largest) {
  std::vector<double> scratch;
  return tempering_exponent(log_priors, log_likelihoods, min_ess, largest, scratch);
}

double tempering_exponent(std::span<const double> log_priors, std::span<const double> log_likelihoods,
                          double min_ess, double largest, std::vector<double>& scratch) {
  CAIRN_ASSERT(log_priors.size() == log_likelihoods.size());
  if (log_priors.empty() || min_ess <= 1.0) return largest;
  scratch.resize(log_priors.size());
  const auto keeps = [&](double log_exponent) {
    return tempered_ess(log_priors, log_likelihoods, std::exp(log_exponent), scratch) >= min_ess;
  };
  double high = std::log(largest);
  if (keeps(high)) return largest;
  double low = high + std::log(kSmallestExponent);
  while (high - low > 1e-3) {
    const double middle = 0.5 * (low + high);
    (keeps(middle) ? low : high) = middle;
  }
  return std::exp(low);
}

}  // namespace cairn
