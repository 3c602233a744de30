#include "cairn/eval/histogram.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kMaxBins = 39.0;

// Smallest of 1, 2, 5 times a power of ten that is not below `width`.
double round_up(double width) {
  const double power = std::pow(10.0, std::floor(std::log10(width)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * power >= width) return step * power;
  }
  return 10.0 * power;
}

}  // namespace

Histogram make_histogram(std::span<const double> values) {
  const double max = values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
  if (!(max > 0.0)) return {1e-3, {static_cast<std::int64_t>(values.size())}};
  Histogram histogram{round_up(max / kMaxBins), {}};
  histogram.counts.resize(static_cast<std::size_t>(max / histogram.width) + 1);
  for (const double value : values) ++histogram.counts[static_cast<std::size_t>(value / histogram.width)];
  return histogram;
}

}  // namespace cairn
