#pragma once

#include <array>
#include <optional>
#include <span>

namespace cairn {

/// A residual of mean zero whose variance is a known part and a sum of multiples of unknown components:
/// known + sum_k factor[k] * component[k].
struct VarianceRow {
  static constexpr int kMost = 3;

  double residual = 0.0;
  double known = 0.0;                        ///< >= 0
  std::array<double, kMost> factor = {0.0};  ///< >= 0; zero for components that the row does not have
};

struct VarianceFit {
  std::array<double, VarianceRow::kMost> component = {0.0};  ///< >= 0
  double outlier_share = 0.0;
  bool converged = false;
};

struct VarianceFitOptions {
  std::optional<VarianceFit> start = std::nullopt;  ///< a fit of similar rows: fewer iterations
  int max_iterations = 200;
};

/// Maximum likelihood of the components under the contaminated normal distribution (Tukey, "A survey of
/// sampling from contaminated distributions", 1960): a share of the residuals, learnt as well, has five times
/// the standard deviation. On clean normal residuals that is the usual estimate; slips and bumps of a few per
/// cent hardly move it. Expectation maximisation; within it, Fisher scoring (weighted least squares of the
/// squared residuals) under the constraint that no component is negative.
/// @param components how many of each row's factors are used: 1..kMost
/// @throws InputError for fewer rows than components, or a row that is not finite or has a negative factor
VarianceFit fit_variance_components(std::span<const VarianceRow> rows, int components,
                                    const VarianceFitOptions& options = {});

}  // namespace cairn
