#include "cairn/eval/ate.hpp"

#include "cairn/core/angle.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

double quantile(const std::vector<double>& sorted, double share) {
  const double rank = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const auto above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (rank - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

Summary summarize(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double sum = 0.0, squares = 0.0, deviations = 0.0;
  for (const double v : values) sum += v;
  const double mean = sum / n;
  for (const double v : values) {
    squares += v * v;
    deviations += (v - mean) * (v - mean);
  }
  return {.count = values.size(),
          .mean = mean,
          .standard_deviation = values.size() > 1 ? std::sqrt(deviations / (n - 1.0)) : 0.0,
          .rms = std::sqrt(squares / n),
          .median = quantile(values, 0.5),
          .p95 = quantile(values, 0.95),
          .max = values.back()};
}

Ate absolute_trajectory_error(std::span<const PosePair> pairs) {
  Ate ate;
  std::vector<double> positions, headings;
  for (const auto& [stamp, reference, estimate] : pairs) {
    ate.errors.push_back(
        {stamp, distance(reference, estimate), angle_difference(estimate.theta, reference.theta)});
    positions.push_back(ate.errors.back().position_m);
    headings.push_back(std::abs(ate.errors.back().heading_rad));
  }
  ate.position_m = summarize(std::move(positions));
  ate.heading_rad = summarize(std::move(headings));
  return ate;
}

}  // namespace cairn
