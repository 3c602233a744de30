#include "cairn/core/variance_components.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/core/rng.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// Residuals with variance 0.5 a + 2 b + known, a and b uniform within (0, 1).
std::vector<VarianceRow> residuals(std::size_t count, double first, double second, double known,
                                   double outliers) {
  const RandomStream random(7, RandomPurpose::kTest, 0);
  std::vector<VarianceRow> rows;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto u = random.uniform4(i, 1);
    VarianceRow row{0.0, known, {u[0], u[1], 0.0}};
    const double sigma = std::sqrt(first * u[0] + second * u[1] + known);
    row.residual = sigma * random.normal4(i)[0] * (u[2] < outliers ? 5.0 : 1.0);
    rows.push_back(row);
  }
  return rows;
}

// Standard errors of the maximum likelihood estimate with 20,000 rows, from the Fisher information of this
// design: below 0.018 for either component (checked by 200 repetitions). Five of them: false alarm below 1e-6
// per bound.
constexpr double kBound = 0.09;

TEST(VarianceComponents, AreFoundInNormalResiduals) {
  const VarianceFit fit = fit_variance_components(residuals(20'000, 0.5, 2.0, 0.0, 0.0), 2);
  EXPECT_TRUE(fit.converged);
  EXPECT_NEAR(fit.component[0], 0.5, kBound);
  EXPECT_NEAR(fit.component[1], 2.0, kBound);
  EXPECT_LT(fit.outlier_share, 0.01);
}

TEST(VarianceComponents, TakeTheKnownPartOff) {
  const VarianceFit fit = fit_variance_components(residuals(20'000, 0.5, 2.0, 0.3, 0.0), 2);
  EXPECT_NEAR(fit.component[0], 0.5, kBound);
  EXPECT_NEAR(fit.component[1], 2.0, kBound);
}

TEST(VarianceComponents, AreNotMovedByOutliers) {
  const VarianceFit fit = fit_variance_components(residuals(20'000, 0.5, 2.0, 0.0, 0.05), 2);
  EXPECT_NEAR(fit.component[0], 0.5, kBound);
  EXPECT_NEAR(fit.component[1], 2.0, kBound);
  EXPECT_NEAR(fit.outlier_share, 0.05, 0.01);
}

TEST(VarianceComponents, AComponentThatIsNotThereIsZeroAndNeverNegative) {
  const VarianceFit fit = fit_variance_components(residuals(20'000, 0.0, 2.0, 0.0, 0.0), 2);
  EXPECT_GE(fit.component[0], 0.0);
  EXPECT_LT(fit.component[0], kBound);
  EXPECT_NEAR(fit.component[1], 2.0, kBound);
}

TEST(VarianceComponents, AFactorThatIsZeroEverywhereStaysOut) {
  const VarianceFit fit = fit_variance_components(residuals(2'000, 0.5, 2.0, 0.0, 0.0), 3);
  EXPECT_EQ(fit.component[2], 0.0);
}

TEST(VarianceComponents, BadRowsAreRefused) {
  std::vector<VarianceRow> rows = residuals(10, 1.0, 1.0, 0.0, 0.0);
  EXPECT_THROW(fit_variance_components(std::vector<VarianceRow>{}, 1), InputError);
  rows[3].residual = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(fit_variance_components(rows, 2), InputError);
}

}  // namespace
}  // namespace cairn
