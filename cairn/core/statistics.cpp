#include "cairn/core/statistics.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/batch_math.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/core/moment_sums.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace cairn {
namespace {

// Below this quantile the density of the Halley step underflows.
constexpr double kHalleyLimit = -37.5;

template <std::size_t N>
double polynomial(const std::array<double, N>& coefficients, double x) {
  double value = 0.0;
  for (const double c : coefficients) value = value * x + c;
  return value;
}

// Acklam 2003: https://en.wikipedia.org/wiki/Normal_distribution#Numerical_approximations (coefficients are
// facts).
double quantile_approximation(double p) {
  constexpr std::array a = {-3.969683028665376e+01, 2.209460984245205e+02,  -2.759285104469687e+02,
                            1.383577518672690e+02,  -3.066479806614716e+01, 2.506628277459239e+00};
  constexpr std::array b = {-5.447609879822406e+01, 1.615858368580409e+02,  -1.556989798598866e+02,
                            6.680131188771972e+01,  -1.328068155288572e+01, 1.0};
  constexpr std::array c = {-7.784894002430293e-03, -3.223964580411365e-01, -2.400758277161838e+00,
                            -2.549732539343734e+00, 4.374664141464968e+00,  2.938163982698783e+00};
  constexpr std::array d = {7.784695709041462e-03, 3.224671290700398e-01, 2.445134137142996e+00,
                            3.754408661907416e+00, 1.0};
  constexpr double kTail = 0.02425;
  const auto tail = [&](double q) { return polynomial(c, q) / polynomial(d, q); };
  if (p < kTail) return tail(std::sqrt(-2.0 * std::log(p)));
  if (p > 1.0 - kTail) return -tail(std::sqrt(-2.0 * std::log(1.0 - p)));
  const double q = p - 0.5;
  return q * polynomial(a, q * q) / polynomial(b, q * q);
}

// sum of exp(value + offset)^power, power 1 or 2.
double sum_of_exp(std::span<const double> values, double offset, double power) {
  constexpr std::size_t kAtOnce = 512;
  std::array<double, kAtOnce> exps;
  double sum = 0.0;
  for (std::size_t begin = 0; begin < values.size(); begin += kAtOnce) {
    const auto part = std::span(exps).first(std::min(kAtOnce, values.size() - begin));
    exp_all(values.subspan(begin, part.size()), offset, part);
    sum += power == 1.0 ? sum_of(part) : sum_of_squares(part);
  }
  return sum;
}

// Beyond, headings are brought into [-pi, pi) first.
constexpr double kLargestHeading = 1e5;

}  // namespace

double log_sum_exp(std::span<const double> values) {
  if (values.empty()) return -std::numeric_limits<double>::infinity();
  const double largest = *std::max_element(values.begin(), values.end());
  if (std::isinf(largest)) return largest;  // infinity minus infinity would not be a number
  return largest + std::log(sum_of_exp(values, -largest, 1.0));
}

double normalize_log_weights(std::span<double> log_weights) {
  const double total = log_sum_exp(log_weights);
  for (double& w : log_weights) w -= total;
  return total;
}

double effective_sample_size(std::span<const double> normalized_log_weights) {
  const double squares = sum_of_exp(normalized_log_weights, 0.0, 2.0);
  return squares > 0.0 ? 1.0 / squares : 0.0;
}

PoseMoments weighted_moments(std::span<const Pose2> poses, std::span<const double> weights) {
  const FirstSums sums = first_sums(poses, weights);
  if (sums.largest_heading > kLargestHeading) {
    std::vector<Pose2> normalized(poses.begin(), poses.end());
    for (Pose2& pose : normalized) pose.theta = normalize_angle(pose.theta);
    return weighted_moments(normalized, weights);
  }
  CAIRN_ASSERT(sums.weight > 0.0);
  PoseMoments moments;
  moments.mean = {sums.x / sums.weight, sums.y / sums.weight,
                  normalize_angle(std::atan2(sums.sine, sums.cosine))};
  const SecondSums s = second_sums(moments.mean, poses, weights);
  moments.covariance << s.xx, s.xy, s.xt, s.xy, s.yy, s.yt, s.xt, s.yt, s.tt;
  moments.covariance /= sums.weight;
  return moments;
}

double normal_quantile(double probability) {
  CAIRN_ASSERT(probability > 0.0 && probability < 1.0);
  // The upper half by symmetry: close to 1 the difference to erfc would be nothing but rounding.
  if (probability > 0.5) return -normal_quantile(1.0 - probability);
  const double x = quantile_approximation(probability);
  if (x < kHalleyLimit) return x;
  const double error = 0.5 * std::erfc(-x / std::numbers::sqrt2) - probability;
  const double step = error * std::sqrt(kTwoPi) * std::exp(x * x / 2.0);
  return x - step / (1.0 + x * step / 2.0);
}

}  // namespace cairn
