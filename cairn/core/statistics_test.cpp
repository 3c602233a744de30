#include "cairn/core/statistics.hpp"

#include "cairn/core/angle.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double log_sum(std::vector<double> values) { return log_sum_exp(values); }

TEST(LogSumExp, OrdinaryValues) {
  EXPECT_NEAR(log_sum({std::log(1.0), std::log(2.0), std::log(3.0)}), std::log(6.0), 1e-15);
  EXPECT_EQ(log_sum({-7.5}), -7.5);
}

TEST(LogSumExp, NeitherOverflowsNorUnderflows) {
  EXPECT_NEAR(log_sum({1000.0, 1000.0}), 1000.0 + std::log(2.0), 1e-12);
  EXPECT_NEAR(log_sum({-1e5, -1e5}), -1e5 + std::log(2.0), 1e-10);
  EXPECT_EQ(log_sum({0.0, -1e308}), 0.0);
  EXPECT_EQ(log_sum({1e308, -1e308}), 1e308);
}

TEST(LogSumExp, InfinitiesAndNothing) {
  EXPECT_EQ(log_sum({}), -kInfinity);
  EXPECT_EQ(log_sum({-kInfinity, -kInfinity}), -kInfinity);
  EXPECT_EQ(log_sum({-kInfinity, 2.0}), 2.0);
  EXPECT_EQ(log_sum({kInfinity, 2.0}), kInfinity);
}

TEST(NormalizeLogWeights, SumsToOneWhateverTheOffset) {
  for (const double offset : {0.0, -1e4, 1e4}) {
    std::vector<double> w = {offset + std::log(1.0), offset + std::log(3.0)};
    EXPECT_NEAR(normalize_log_weights(w), offset + std::log(4.0), 1e-11);
    EXPECT_NEAR(std::exp(w[0]), 0.25, 1e-11);
    EXPECT_NEAR(std::exp(w[1]), 0.75, 1e-11);
  }
}

double ess_of(std::vector<double> weights) {
  for (double& w : weights) w = std::log(w);
  normalize_log_weights(weights);
  return effective_sample_size(weights);
}

TEST(EffectiveSampleSize, Laws) {
  EXPECT_NEAR(ess_of(std::vector<double>(100, 5.0)), 100.0, 1e-9);  // equal weights: all count
  EXPECT_NEAR(ess_of({1.0, 1e-200, 1e-200}), 1.0, 1e-12);           // one survivor
  EXPECT_NEAR(ess_of({1.0, 1.0, 1e-200, 1e-200}), 2.0, 1e-12);      // k equal ones of N
  EXPECT_NEAR(ess_of({1.0, 2.0, 3.0}), 36.0 / 14.0, 1e-12);
  EXPECT_NEAR(ess_of({10.0, 20.0, 30.0}), ess_of({3.0, 1.0, 2.0}), 1e-12);  // scale and order do not matter
  EXPECT_EQ(effective_sample_size({}), 0.0);
}

TEST(WeightedMoments, ByHand) {
  const std::array poses = {Pose2{0, 0, 0.1}, Pose2{4, 2, 0.3}};
  const PoseMoments m = weighted_moments(poses, std::array{3.0, 1.0});
  EXPECT_NEAR(m.mean.x, 1.0, 1e-15);
  EXPECT_NEAR(m.mean.y, 0.5, 1e-15);
  EXPECT_NEAR(m.covariance(0, 0), 0.75 * 1.0 + 0.25 * 9.0, 1e-15);
  EXPECT_NEAR(m.covariance(0, 1), 0.75 * 0.5 + 0.25 * 4.5, 1e-15);
  EXPECT_NEAR(m.covariance(1, 1), 0.75 * 0.25 + 0.25 * 2.25, 1e-15);
  EXPECT_EQ(m.covariance, Eigen::Matrix3d(m.covariance.transpose()));
}

TEST(WeightedMoments, FacingWestIsLikeFacingEast) {
  const std::array east = {Pose2{0, 0, -0.2}, Pose2{1, 0, 0.0}, Pose2{0, 1, 0.2}};
  std::array west = east;
  for (Pose2& p : west) p.theta = normalize_angle(p.theta + kPi);
  const std::array weights = {1.0, 2.0, 1.0};
  const PoseMoments a = weighted_moments(east, weights), b = weighted_moments(west, weights);
  EXPECT_NEAR(std::abs(b.mean.theta), kPi, 1e-15);
  EXPECT_LT(b.mean.theta, kPi);  // the interval is half open
  EXPECT_NEAR(b.covariance(2, 2), 0.02, 1e-14);
  EXPECT_TRUE(a.covariance.isApprox(b.covariance, 1e-13)) << b.covariance;
}

TEST(WeightedMoments, ScaleOfTheWeightsDoesNotMatter) {
  const std::array poses = {Pose2{0, 0, 3.1}, Pose2{4, 2, -3.1}};
  const PoseMoments a = weighted_moments(poses, std::array{0.25, 0.75});
  const PoseMoments b = weighted_moments(poses, std::array{25.0, 75.0});
  EXPECT_TRUE(a.covariance.isApprox(b.covariance, 1e-14));
  EXPECT_NEAR(angle_difference(a.mean.theta, b.mean.theta), 0.0, 1e-15);
}

TEST(WeightedMoments, RefusesNothing) {
  EXPECT_THROW(weighted_moments({}, {}), std::logic_error);
  EXPECT_THROW(weighted_moments(std::array{Pose2{}}, std::array{0.0}), std::logic_error);
  EXPECT_THROW(weighted_moments(std::array{Pose2{}}, std::array{1.0, 1.0}), std::logic_error);
}

// Known values: tables of the normal distribution, 13 digits.
TEST(NormalQuantile, KnownValues) {
  EXPECT_EQ(normal_quantile(0.5), 0.0);
  EXPECT_NEAR(normal_quantile(0.99), 2.3263478740408, 1e-12);
  EXPECT_NEAR(normal_quantile(0.975), 1.9599639845401, 1e-12);
  EXPECT_NEAR(normal_quantile(0.84134474606854), 1.0, 1e-12);
  EXPECT_NEAR(normal_quantile(0.999), 3.0902323061678, 1e-12);
  EXPECT_NEAR(normal_quantile(0.999999), 4.7534243088229, 1e-9);
  EXPECT_NEAR(normal_quantile(1e-9), -5.9978070150077, 1e-12);
}

TEST(NormalQuantile, IsTheInverseOfTheDistribution) {
  for (double z = -35.0; z <= 8.0; z += 0.37) {
    const double p = 0.5 * std::erfc(-z / std::sqrt(2.0));
    if (z > 0.0 && 1.0 - p < 1e-13) continue;  // p itself no longer tells z
    const double spacing = z > 0.0 ? 1.2e-16 * std::sqrt(kTwoPi) * std::exp(z * z / 2.0) : 0.0;
    EXPECT_NEAR(normal_quantile(p), z, 1.2e-9 * std::abs(z) + spacing) << z;
  }
}

TEST(NormalQuantile, IsOddAndGrowsUpToTheEnds) {
  const double near_one = 1.0 - 0x1p-53;
  EXPECT_EQ(normal_quantile(near_one), -normal_quantile(0x1p-53));
  EXPECT_NEAR(normal_quantile(near_one), 8.2095361516014, 1e-8);
  EXPECT_EQ(normal_quantile(0.75), -normal_quantile(0.25));
  EXPECT_NEAR(normal_quantile(1e-300), -37.0471, 1e-4);
  EXPECT_TRUE(std::isfinite(normal_quantile(std::numeric_limits<double>::denorm_min())));
  EXPECT_LT(normal_quantile(std::numeric_limits<double>::denorm_min()), normal_quantile(1e-300));
}

TEST(NormalQuantile, RefusesWhatIsNoProbability) {
  for (const double p : {0.0, 1.0, -0.1, 1.1, kInfinity, std::nan("")}) {
    EXPECT_THROW(normal_quantile(p), std::logic_error) << p;
  }
}

}  // namespace
}  // namespace cairn
