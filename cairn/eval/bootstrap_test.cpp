#include "cairn/eval/bootstrap.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/core/rng.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

std::vector<double> normal_values(std::size_t count, std::uint64_t step) {
  const RandomStream random(7, RandomPurpose::kTest, step);
  std::vector<double> values;
  for (std::uint32_t i = 0; i < count; ++i) values.push_back(random.normal4(i)[0]);
  return values;
}

TEST(Bootstrap, MeanIsThatOfTheSample) {
  const std::vector<double> values{1.0, 2.0, 6.0};
  const MeanInterval interval = bootstrap_mean(values);
  EXPECT_EQ(interval.count, 3U);
  EXPECT_DOUBLE_EQ(interval.mean, 3.0);
  EXPECT_LT(interval.low, 3.0);
  EXPECT_GT(interval.high, 3.0);
  EXPECT_GE(interval.low, 1.0);
  EXPECT_LE(interval.high, 6.0);
}

TEST(Bootstrap, ConstantValuesHaveAnIntervalWithoutWidth) {
  const MeanInterval interval = bootstrap_mean(std::vector<double>(9, 0.25));
  EXPECT_DOUBLE_EQ(interval.low, 0.25);
  EXPECT_DOUBLE_EQ(interval.high, 0.25);
}

TEST(Bootstrap, TooFewValuesHaveNoInterval) {
  EXPECT_TRUE(std::isnan(bootstrap_mean({}).mean));
  const MeanInterval one = bootstrap_mean(std::vector{2.0});
  EXPECT_EQ(one.mean, 2.0);
  EXPECT_TRUE(std::isnan(one.low));
  EXPECT_TRUE(std::isnan(one.high));
}

// Two values: the mean of a resample is a, (a + b) / 2 or b with probability 1/4, 1/2, 1/4, so that the 95 %
// interval is [a, b] and the 40 % one is the middle alone.
TEST(Bootstrap, TwoValuesByHand) {
  const std::vector<double> values{0.0, 1.0};
  const MeanInterval wide = bootstrap_mean(values);
  EXPECT_EQ(wide.low, 0.0);
  EXPECT_EQ(wide.high, 1.0);
  const MeanInterval narrow = bootstrap_mean(values, {.level = 0.4});
  EXPECT_EQ(narrow.low, 0.5);
  EXPECT_EQ(narrow.high, 0.5);
}

// For many normal values the interval is mean +- 1.96 sigma / sqrt(n); the quantiles of 10000 resamples have
// a relative error of about 3 %.
TEST(Bootstrap, ApproachesTheNormalInterval) {
  const std::vector<double> values = normal_values(400, 0);
  double squares = 0.0;
  const MeanInterval interval = bootstrap_mean(values);
  for (const double v : values) squares += (v - interval.mean) * (v - interval.mean);
  const double expected = 1.959964 * std::sqrt(squares / 400.0 / 400.0);
  EXPECT_NEAR(interval.high - interval.mean, expected, 0.1 * expected);
  EXPECT_NEAR(interval.mean - interval.low, expected, 0.1 * expected);
}

// Of 400 samples of 30 normal values about 94 % of the 95 % intervals hold the true mean 0. Binomial, p >=
// 0.9, alpha 1e-6: at least 328 of 400.
TEST(Bootstrap, HoldsTheTruthAboutAsOftenAsItSays) {
  int holds = 0;
  for (std::uint64_t i = 1; i <= 400; ++i) {
    const MeanInterval interval = bootstrap_mean(normal_values(30, i), {.resamples = 500});
    holds += interval.low <= 0.0 && interval.high >= 0.0 ? 1 : 0;
  }
  EXPECT_GE(holds, 328);
  EXPECT_LE(holds, 396);
}

TEST(Bootstrap, TheSameSeedGivesTheSameBytes) {
  const std::vector<double> values = normal_values(20, 3);
  EXPECT_EQ(bootstrap_mean(values).low, bootstrap_mean(values).low);
  EXPECT_NE(bootstrap_mean(values).low, bootstrap_mean(values, {.seed = 2}).low);
}

TEST(Bootstrap, RefusesImpossibleOptions) {
  const std::vector<double> values{1.0, 2.0};
  EXPECT_THROW(bootstrap_mean(values, {.resamples = 0}), ConfigurationError);
  EXPECT_THROW(bootstrap_mean(values, {.level = 1.0}), ConfigurationError);
  EXPECT_THROW(bootstrap_mean(values, {.level = std::nan("")}), ConfigurationError);
}

}  // namespace
}  // namespace cairn
