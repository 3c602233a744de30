#include "cairn/models/sensor/beam_model_em.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kLeastWeight = 1e-6;  // that the options allow
constexpr double kLeastSigma_m = 1e-3;
constexpr double kLambdaFrom = 1e-3, kLambdaTo = 100.0;  // 1/m
constexpr int kBisections = 40;
constexpr double kSureNoReturn = -8.0;  // standard deviations that the wall lies beyond the reach

// What an expectation step adds up over the samples.
struct Expectation {
  double hit = 0.0, unexpected = 0.0, max = 0.0, rand = 0.0;  ///< responsibilities
  double square = 0.0, square_weight = 0.0;                   ///< of the noise of hits
  double short_z = 0.0;                                       ///< of short readings, sum of weight * z
  struct Short {
    double weight, expected_m;
  };
  std::vector<Short> shorts;
  double log_likelihood = 0.0;
};

// E[(z - r)^2 | z >= z_max] / sigma^2 for z ~ N(r, sigma), with a = (z_max - r) / sigma.
double square_beyond(double a) {
  const double density = 0.3989422804014327 * std::exp(-0.5 * a * a);
  const double tail = 0.5 * std::erfc(a / std::sqrt(2.0));
  return tail > 1e-290 ? 1.0 + a * density / tail : 1.0 + a * a;
}

Expectation expect(std::span<const BeamSample> samples, double max_range_m, const BeamModelOptions& o) {
  const BeamMixture mixture(o, max_range_m);
  Expectation e;
  for (const BeamSample& s : samples) {
    const BeamMixture::Terms t = mixture.terms(s.z_m, s.expected_m);
    const double sum = t.sum();
    const double hit = t.hit / sum, near = t.unexpected / sum;
    e.log_likelihood += std::log(sum);
    e.hit += hit;
    e.max += t.max / sum;
    e.rand += t.rand / sum;
    const double a = (max_range_m - s.expected_m) / o.sigma_hit_m;
    const bool is_return = s.z_m < max_range_m;
    if (is_return || a > kSureNoReturn) {
      const double deviation = s.z_m - s.expected_m;
      e.square +=
          hit * (is_return ? deviation * deviation : o.sigma_hit_m * o.sigma_hit_m * square_beyond(a));
      e.square_weight += hit;
    }
    if (near < 1e-9) continue;
    e.unexpected += near;
    e.short_z += near * s.z_m;
    e.shorts.push_back({near, s.expected_m});
  }
  return e;
}

// The lambda of an exponential distribution that is cut off at a range of its own for every sample: where
//   sum_i w_i (1 / lambda - z_i - r_i / (exp(lambda r_i) - 1)) = 0
// The left side falls with lambda.
double best_lambda(const Expectation& e) {
  const auto slope = [&](double lambda) {
    double sum = e.unexpected / lambda - e.short_z;
    for (const auto& s : e.shorts) {
      const double exponent = lambda * s.expected_m;
      if (exponent < 700.0) sum -= s.weight * s.expected_m / std::expm1(std::max(exponent, 1e-12));
    }
    return sum;
  };
  double low = std::log(kLambdaFrom), high = std::log(kLambdaTo);
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (low + high);
    (slope(std::exp(middle)) > 0.0 ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

BeamModelOptions maximize(const Expectation& e, BeamModelOptions o) {
  const double sum = e.hit + e.unexpected + e.max + e.rand;
  o.z_hit = std::max(e.hit / sum, kLeastWeight);
  o.z_short = std::max(e.unexpected / sum, kLeastWeight);
  o.z_max = std::max(e.max / sum, kLeastWeight);
  o.z_rand = std::max(e.rand / sum, kLeastWeight);
  if (e.square_weight > 0.0) {
    o.sigma_hit_m = std::max(std::sqrt(e.square / e.square_weight), kLeastSigma_m);
  }
  if (e.unexpected > 0.0) o.lambda_short_per_m = best_lambda(e);
  return o;
}

void check(std::span<const BeamSample> samples) {
  if (samples.empty()) throw InputError("beam samples", "there are none", "give a log with usable scans");
  const auto is_bad = [](const BeamSample& s) {
    return !(s.z_m > 0.0 && s.expected_m >= 0.0 && std::isfinite(s.z_m) && std::isfinite(s.expected_m));
  };
  if (std::any_of(samples.begin(), samples.end(), is_bad)) {
    throw InputError("beam samples", "a range is negative or not finite", "leave such readings out");
  }
}

// All weights above 0: one that starts at 0 stays there.
BeamModelOptions open_minded(BeamModelOptions o) {
  for (double* weight : {&o.z_hit, &o.z_short, &o.z_max, &o.z_rand}) *weight = std::max(*weight, 1e-3);
  return o;
}

}  // namespace

double mean_log_likelihood(std::span<const BeamSample> samples, double max_range_m,
                           const BeamModelOptions& options) {
  const BeamMixture mixture(options, max_range_m);
  double sum = 0.0;
  for (const BeamSample& s : samples) sum += mixture.log_likelihood(s.z_m, s.expected_m);
  return sum / static_cast<double>(samples.size());
}

BeamEmResult learn_beam_model(std::span<const BeamSample> samples, double max_range_m,
                              const BeamModelOptions& start, const BeamEmLimits& limits) {
  check(samples);
  BeamEmResult result;
  BeamModelOptions options = open_minded(start);
  for (int i = 0; i <= limits.max_iterations; ++i) {
    const Expectation e = expect(samples, max_range_m, options);
    const double mean = e.log_likelihood / static_cast<double>(samples.size());
    result.converged =
        !result.steps.empty() && mean - result.steps.back().mean_log_likelihood < limits.tolerance;
    result.steps.push_back({mean, options});
    if (result.converged) break;
    options = maximize(e, options);
  }
  return result;
}

}  // namespace cairn
