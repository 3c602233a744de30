#include "cairn/models/sensor/late_ranges.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/core/rng.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr std::uint32_t kCount = 4000;

std::vector<double> errors(double bias, double sigma, double late_share, double late_mean,
                           std::uint64_t seed) {
  const RandomStream random(seed, RandomPurpose::kEvaluation, 0);
  std::vector<double> values;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    double value = bias + sigma * random.normal4(i, 0)[0];
    if (random.uniform(i, 1) < late_share) value -= late_mean * std::log(random.uniform(i, 2));
    values.push_back(value);
  }
  return values;
}

// Five standard errors, a little more for what the components share: a false alarm in a million seeds.
TEST(LateRanges, FindsWhatWasDrawn) {
  const std::vector<std::vector<double>> groups{errors(0.1, 0.05, 0.4, 2.0, 1),
                                                errors(0.1, 0.05, 0.0, 1.0, 2)};
  const LateRangeFit fit = fit_late_ranges(groups);
  EXPECT_NEAR(fit.bias_m, 0.1, 0.005);
  EXPECT_NEAR(fit.sigma_m, 0.05, 0.004);
  EXPECT_NEAR(fit.beacons[0].late_share, 0.4, 0.05);
  EXPECT_NEAR(fit.beacons[0].late_mean_m, 2.0, 0.3);
  EXPECT_LT(fit.beacons[1].late_share, 0.03);
  EXPECT_LT(fit.beacons[0].wrong_share, 0.02);
}

TEST(LateRanges, WrongRangesBendNothing) {
  std::vector<std::vector<double>> groups{errors(-0.2, 0.1, 0.2, 1.0, 3)};
  for (int i = 0; i < 200; ++i) groups[0].push_back(-19.0 + 0.09 * i);
  groups[0].push_back(1e6);
  const LateRangeFit fit = fit_late_ranges(groups);
  EXPECT_NEAR(fit.bias_m, -0.2, 0.02);
  EXPECT_NEAR(fit.sigma_m, 0.1, 0.015);
  EXPECT_NEAR(fit.beacons[0].wrong_share, 0.05, 0.02);
}

TEST(LateRanges, RefusesTooFewAndWhatIsNoNumber) {
  const std::vector<std::vector<double>> few{{0.1, 0.2}};
  EXPECT_THROW(fit_late_ranges(few), InputError);
  std::vector<std::vector<double>> bad{errors(0, 1, 0, 1, 1)};
  bad[0][3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(fit_late_ranges(bad), InputError);
}

}  // namespace
}  // namespace cairn
