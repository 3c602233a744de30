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
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  if (sorted.empty() || !(sorted.back() > 0.0)) return {1e-3, {static_cast<std::int64_t>(values.size())}, 0};
  const double p99 = sorted[(sorted.size() * 99 + 99) / 100 - 1];
  const double reach = p99 > 0.0 ? p99 : sorted.back();
  Histogram histogram{round_up(reach / kMaxBins), {}, 0};
  histogram.counts.resize(static_cast<std::size_t>(reach / histogram.width) + 1);
  for (const double value : values) {
    const double bin = value / histogram.width;
    if (bin < static_cast<double>(histogram.counts.size()))
      ++histogram.counts[static_cast<std::size_t>(bin)];
    else
      ++histogram.beyond;
  }
  return histogram;
}

}  // namespace cairn
