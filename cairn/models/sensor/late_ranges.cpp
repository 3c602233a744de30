#include "cairn/models/sensor/late_ranges.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cairn {
namespace {

constexpr double kFarthest_m = 20.0;
constexpr double kWrongDensity = 1.0 / (2.0 * kFarthest_m);
constexpr double kLeastSigma_m = 1e-3;
constexpr double kLeastMean_m = 1e-3;
constexpr std::size_t kFewest = 10;
constexpr int kIterations = 500;
constexpr double kTolerance = 1e-9;

double normal_density(double x) { return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi); }

double normal_probability(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

// density / probability of the standard normal distribution, also far to the left, where both vanish.
double mills(double x) {
  if (x < -30.0) return -x - 1.0 / x;
  return normal_density(x) / normal_probability(x);
}

// The delay within a late error, given the error: a normal number cut off at zero.
struct Delay {
  double mean_m = 0.0;
  double variance = 0.0;
};

struct Parameters {
  double bias, sigma;

  double punctual(double error) const { return normal_density((error - bias) / sigma) / sigma; }

  double late(double error, double mean) const {
    const double ratio = sigma / mean, z = (error - bias) / sigma;
    const double exponent = 0.5 * ratio * ratio - (error - bias) / mean;
    const double tail = normal_probability(z - ratio);
    return exponent > 600.0 || tail <= 0.0 ? 0.0 : std::exp(exponent) * tail / mean;
  }

  Delay delay(double error, double mean) const {
    const double shift = error - bias - sigma * sigma / mean;
    const double x = shift / sigma, hazard = mills(x);
    return {std::max(0.0, shift + sigma * hazard),
            sigma * sigma * std::max(0.0, 1.0 - hazard * (hazard + x))};
  }
};

// Sums that the next parameters follow from.
struct Sums {
  double weight = 0.0, value = 0.0, square = 0.0;  // of the normal parts, about the bias before
  double total = 0.0, log_likelihood = 0.0;
};

// Adds to the sums, and to what follows for the beacon: shares and the mean are still sums there.
void add_error(double error, const Parameters& p, const LateRangeFit::Beacon& before, Sums& sums,
               LateRangeFit::Beacon& after) {
  const double good = 1.0 - before.wrong_share;
  const double mean = std::max(kLeastMean_m, before.late_mean_m);
  const double punctual = good * (1.0 - before.late_share) * p.punctual(error);
  const double late = good * before.late_share * p.late(error, mean);
  const double wrong = before.wrong_share * kWrongDensity;
  const double all = punctual + late + wrong;
  const Delay delay = p.delay(error, mean);
  const double a = punctual / all, b = late / all;
  const double off = error - p.bias, off_late = off - delay.mean_m;
  sums.weight += a + b;
  sums.value += a * off + b * off_late;
  sums.square += a * off * off + b * (off_late * off_late + delay.variance);
  sums.total += 1.0;
  sums.log_likelihood += std::log(all);
  after.wrong_share += wrong / all;
  after.late_share += b;
  after.late_mean_m += b * delay.mean_m;
  ++after.count;
}

// The sums become shares and a mean.
void settle(LateRangeFit::Beacon& beacon) {
  const auto n = static_cast<double>(beacon.count);
  const double good = n - beacon.wrong_share;
  beacon.late_mean_m = beacon.late_share > 1e-9 ? beacon.late_mean_m / beacon.late_share : 0.0;
  beacon.late_share = good > 0.0 ? beacon.late_share / good : 0.0;
  beacon.wrong_share = n > 0.0 ? std::max(1e-6, beacon.wrong_share / n) : 0.0;  // never stuck at none
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

LateRangeFit start_of(std::span<const std::vector<double>> groups) {
  std::vector<double> all;
  for (const auto& group : groups) {
    for (const double error : group) {
      if (!std::isfinite(error)) throw InputError("ranges", "an error is not finite", "remove it");
      if (std::abs(error) < kFarthest_m) all.push_back(error);
    }
  }
  if (all.size() < kFewest)
    throw InputError("log", "tells fewer than ten ranges within 20 m of the truth", "use a longer log");
  LateRangeFit fit;
  fit.bias_m = median_of(all);
  std::vector<double> off;
  off.reserve(all.size());
  for (const double error : all) off.push_back(std::abs(error - fit.bias_m));
  fit.sigma_m = std::max(0.02, 1.4826 * median_of(off));
  for (const auto& group : groups) fit.beacons.push_back({group.size(), 0.05, 0.2, 1.0});
  return fit;
}

// One round of expectation and maximisation; returns the mean log-likelihood before it.
double improve(std::span<const std::vector<double>> groups, LateRangeFit& fit) {
  const Parameters p{fit.bias_m, fit.sigma_m};
  Sums sums;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    LateRangeFit::Beacon after;
    for (const double error : groups[g]) {
      if (std::abs(error) < kFarthest_m) add_error(error, p, fit.beacons[g], sums, after);
    }
    settle(after);
    fit.beacons[g] = after;
  }
  const double shift = sums.value / sums.weight;
  fit.bias_m += shift;
  fit.sigma_m = std::max(kLeastSigma_m, std::sqrt(std::max(0.0, sums.square / sums.weight - shift * shift)));
  return sums.log_likelihood / sums.total;
}

}  // namespace

LateRangeFit fit_late_ranges(std::span<const std::vector<double>> errors_m) {
  LateRangeFit fit = start_of(errors_m);
  double before = improve(errors_m, fit);
  for (int i = 1; i < kIterations; ++i) {
    const double now = improve(errors_m, fit);
    if (now - before < kTolerance) break;
    before = now;
  }
  return fit;
}

}  // namespace cairn
