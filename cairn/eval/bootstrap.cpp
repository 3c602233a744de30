#include "cairn/eval/bootstrap.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/core/rng.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace cairn {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kPerBlock = 4;

double mean_of(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double resampled_mean(std::span<const double> values, const RandomStream& random) {
  const auto n = values.size();
  double sum = 0.0;
  for (std::size_t i = 0; i < n; i += kPerBlock) {
    const auto uniform = random.uniform4(static_cast<std::uint32_t>(i / kPerBlock));
    for (std::size_t k = 0; k < kPerBlock && i + k < n; ++k) {
      sum += values[std::min(n - 1, static_cast<std::size_t>(uniform[k] * static_cast<double>(n)))];
    }
  }
  return sum / static_cast<double>(n);
}

// Of sorted values, between the two nearest ranks.
double quantile(const std::vector<double>& sorted, double share) {
  const double rank = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const auto above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], rank - static_cast<double>(below));
}

}  // namespace

void BootstrapOptions::validate() const {
  if (resamples < 100 || resamples > 1'000'000) {
    throw ConfigurationError("resamples", "is out of range", "give a value from 100 to 1000000");
  }
  if (!(level > 0.0 && level < 1.0)) {
    throw ConfigurationError("level", "is not between 0 and 1", "give for example 0.95");
  }
}

MeanInterval bootstrap_mean(std::span<const double> values, const BootstrapOptions& options) {
  options.validate();
  if (values.empty()) return {0, kUndefined, kUndefined, kUndefined};
  if (values.size() == 1) return {1, values[0], kUndefined, kUndefined};
  std::vector<double> means;
  means.reserve(static_cast<std::size_t>(options.resamples));
  for (int i = 0; i < options.resamples; ++i) {
    means.push_back(
        resampled_mean(values, {options.seed, RandomPurpose::kEvaluation, static_cast<std::uint64_t>(i)}));
  }
  std::sort(means.begin(), means.end());
  const double tail = 0.5 * (1.0 - options.level);
  return {values.size(), mean_of(values), quantile(means, tail), quantile(means, 1.0 - tail)};
}

}  // namespace cairn
