#include "cairn/bayes/kld.hpp"

#include "cairn/core/angle.hpp"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace cairn {
namespace {

KldOptions options(double epsilon, double confidence) {
  KldOptions o;
  o.epsilon = epsilon;
  o.confidence = confidence;
  return o;
}

// Fox's formula with k - 1 = occupied bins minus one and z the quantile itself (2.326 for 0.99), by hand.
TEST(KldBound, ValuesOfTheFormula) {
  EXPECT_EQ(kld_bound(2, options(0.1, 0.99)), 33u);     // 5 * (0.777778 + 0.471405 * 2.32635)^3 = 32.93
  EXPECT_EQ(kld_bound(10, options(0.05, 0.99)), 217u);  // 90 * (0.975309 + 0.157135 * 2.32635)^3 = 216.97
  EXPECT_EQ(kld_bound(101, options(0.05, 0.99)),
            1359u);  // 1000 * (0.997778 + 0.0471405 * 2.32635)^3 = 1358.2
}

// The bound is the chi-square quantile over 2 epsilon; quantiles from tables, approximation within 1 %.
TEST(KldBound, IsAChiSquareQuantile) {
  EXPECT_NEAR(static_cast<double>(kld_bound(11, options(0.01, 0.99))), 23.209 / 0.02, 12.0);
  EXPECT_NEAR(static_cast<double>(kld_bound(101, options(0.01, 0.95))), 124.342 / 0.02, 7.0);
  EXPECT_NEAR(static_cast<double>(kld_bound(51, options(0.01, 0.5))), 49.335 / 0.02, 7.0);
}

TEST(KldBound, OneBinAsksForOneSample) {
  EXPECT_EQ(kld_bound(0, {}), 1u);
  EXPECT_EQ(kld_bound(1, {}), 1u);
}

TEST(KldBound, GrowsWithTheBinsTheConfidenceAndThePrecision) {
  for (std::size_t k = 1; k < 2000; ++k) ASSERT_LT(kld_bound(k, {}), kld_bound(k + 1, {})) << k;
  EXPECT_LT(kld_bound(50, options(0.1, 0.9)), kld_bound(50, options(0.1, 0.99)));
  EXPECT_LT(kld_bound(50, options(0.1, 0.99)), kld_bound(50, options(0.05, 0.99)));
}

TEST(PoseBins, CellsOfTheGrid) {
  const PoseBins bins{KldOptions{}};  // 0.5 m, 36 headings
  EXPECT_EQ(bins.key({0.1, 0.1, 0.01}), bins.key({0.49, 0.49, 0.17}));
  const std::set<std::uint64_t> different = {bins.key({0.1, 0.1, 0.01}),  bins.key({0.6, 0.1, 0.01}),
                                             bins.key({0.1, 0.6, 0.01}),  bins.key({0.1, 0.1, 0.18}),
                                             bins.key({-0.1, 0.1, 0.01}), bins.key({0.1, -0.1, 0.01}),
                                             bins.key({0.1, 0.1, -0.01})};
  EXPECT_EQ(different.size(), 7u);
}

TEST(PoseBins, HeadingsThatDifferByFullTurnsShareABin) {
  const PoseBins bins{KldOptions{}};
  for (const double theta : {-3.1, -1.0, 0.05, 2.0, 3.1}) {
    for (const int turns : {-3, -1, 1, 2}) {
      EXPECT_EQ(bins.key({1, 1, theta}), bins.key({1, 1, theta + turns * kTwoPi})) << theta;
    }
  }
}

// Bins that do not divide the circle evenly must not leave a sliver at +-pi that counts twice.
TEST(PoseBins, AWholeNumberOfBinsFillsTheCircle) {
  for (const double size : {0.1745, 0.3, 0.5, 1.0, 2.5, 3.2}) {
    KldOptions o;
    o.bin_size_rad = size;
    const PoseBins bins(o);
    std::set<std::uint64_t> keys;
    for (int i = 0; i < 10'000; ++i) keys.insert(bins.key({0, 0, -kPi + (i + 0.5) * kTwoPi / 10'000}));
    EXPECT_EQ(keys.size(), static_cast<std::size_t>(std::lround(kTwoPi / size))) << size;
  }
}

TEST(PoseBins, AreUniqueOverALargeMap) {
  const PoseBins bins{KldOptions{}};
  std::set<std::uint64_t> keys;
  for (const double x : {-5e5, -1.0, 0.0, 1.0, 5e5}) {
    for (const double y : {-5e5, -1.0, 0.0, 1.0, 5e5}) keys.insert(bins.key({x, y, 0.1}));
  }
  EXPECT_EQ(keys.size(), 25u);
}

}  // namespace
}  // namespace cairn
