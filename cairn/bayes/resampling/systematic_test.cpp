#include "cairn/bayes/resampling/systematic.hpp"

#include "cairn/core/rng.hpp"
#include "cairn/core/statistics.hpp"
#include "simd_paths.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <gtest/gtest.h>

namespace cairn {
namespace {

std::vector<double> log_weights(std::vector<double> weights) {
  for (double& w : weights) w = std::log(w);
  normalize_log_weights(weights);
  return weights;
}

std::vector<std::size_t> counts_of(const std::vector<double>& weights, std::size_t count, double offset) {
  std::vector<std::uint32_t> ancestors;
  draw_systematic(cumulative_weights(log_weights(weights)), count, offset, ancestors);
  EXPECT_EQ(ancestors.size(), count);
  EXPECT_TRUE(std::is_sorted(ancestors.begin(), ancestors.end()));
  std::vector<std::size_t> counts(weights.size());
  for (const std::uint32_t a : ancestors) ++counts.at(a);
  return counts;
}

std::vector<double> random_weights(std::size_t n, std::uint64_t step) {
  const RandomStream random(1, RandomPurpose::kTest, step);
  std::vector<double> weights;
  for (std::uint32_t i = 0; i < n; ++i) weights.push_back(-std::log(random.uniform(i)));
  return weights;
}

TEST(CumulativeWeights, AddUpToExactlyOne) {
  for (const double share : {1.0, 0.3, 1e-9}) {
    const auto c = cumulative_weights(log_weights({share, 2.0, 0.1, share}));
    EXPECT_TRUE(std::is_sorted(c.begin(), c.end()));
    EXPECT_EQ(c.back(), 1.0);
  }
  const auto c = cumulative_weights(log_weights({1.0, 3.0, 4.0}));
  EXPECT_NEAR(c[0], 0.125, 1e-15);
  EXPECT_NEAR(c[1], 0.5, 1e-15);
  EXPECT_THROW(cumulative_weights({}), std::logic_error);
}

TEST(CumulativeSums, EveryPathGivesTheSameBitsAndEachIsASum) {
  for (const std::size_t n : {1u, 2u, 5u, 16u, 17u, 1003u}) {
    const auto weights = random_weights(n, n);
    std::vector<double> expected;
    cumulative_sums(weights, expected);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(expected[i], (sum += weights[i]) / total, 1e-13) << i;
    EXPECT_TRUE(std::is_sorted(expected.begin(), expected.end()));
    EXPECT_EQ(expected.back(), 1.0);
    test::on_every_simd_path([&](SimdPath path) {
      std::vector<double> found;
      cumulative_sums(weights, found);
      EXPECT_EQ(found, expected) << name_of(path) << ' ' << n;
    });
  }
}

TEST(Systematic, ByHand) {
  EXPECT_EQ(counts_of({1.0, 3.0, 4.0}, 8, 0.5), (std::vector<std::size_t>{1, 3, 4}));
  EXPECT_EQ(counts_of({0.5, 0.5}, 1, 0.49), (std::vector<std::size_t>{1, 0}));
  EXPECT_EQ(counts_of({0.5, 0.5}, 1, 0.51), (std::vector<std::size_t>{0, 1}));
}

TEST(Systematic, CountsLieWithinOneOfTheirExpectation) {
  for (std::uint64_t step = 0; step < 20; ++step) {
    const auto weights = random_weights(50, step);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (const std::size_t count : {1u, 7u, 50u, 1000u}) {
      for (const double offset : {1e-10, 0.3, 1.0 - 1e-10}) {
        const auto counts = counts_of(weights, count, offset);
        for (std::size_t i = 0; i < 50; ++i) {
          const double expected = static_cast<double>(count) * weights[i] / total;
          EXPECT_LT(std::abs(static_cast<double>(counts[i]) - expected), 1.0 + 1e-9);
        }
      }
    }
  }
}

// One weight of many teeth, many of none, more indices than are looked at together.
TEST(Systematic, EveryPathDrawsWhatLiesUnderThePlainComb) {
  for (const std::size_t n : {1u, 3u, 4u, 255u, 256u, 257u, 1003u}) {
    auto weights = random_weights(n, n);
    weights[n / 2] += 0.3 * static_cast<double>(n);
    const auto cumulative = cumulative_weights(log_weights(weights));
    for (const std::size_t count : {0u, 1u, 7u, 64u, 1000u}) {
      std::vector<std::uint32_t> expected = {77};
      std::uint32_t index = 0;
      for (std::size_t tooth = 0; tooth < count; ++tooth) {
        while (cumulative[index] * static_cast<double>(count) - 0.37 <= static_cast<double>(tooth)) ++index;
        expected.push_back(index);
      }
      test::on_every_simd_path([&](SimdPath path) {
        std::vector<std::uint32_t> ancestors = {77};
        draw_systematic(cumulative, count, 0.37, ancestors);
        EXPECT_EQ(ancestors, expected) << name_of(path) << ' ' << n << ' ' << count;
      });
    }
  }
}

// The mean over evenly spaced offsets is the expectation: the scheme is unbiased (error 1 / offsets).
TEST(Systematic, IsUnbiasedOverTheOffset) {
  const auto weights = random_weights(10, 99);
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  constexpr int kOffsets = 1000;
  std::vector<double> mean(weights.size());
  for (int k = 0; k < kOffsets; ++k) {
    const auto counts = counts_of(weights, 13, (k + 0.5) / kOffsets);
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += static_cast<double>(counts[i]) / kOffsets;
  }
  for (std::size_t i = 0; i < mean.size(); ++i) EXPECT_NEAR(mean[i], 13.0 * weights[i] / total, 2e-3);
}

TEST(Systematic, EqualWeightsKeepEveryone) {
  for (const double offset : {0.001, 0.5, 0.999}) {
    EXPECT_EQ(counts_of(std::vector<double>(100, 1.0), 100, offset), std::vector<std::size_t>(100, 1));
  }
}

TEST(Systematic, WhatWeighsNothingIsNeverDrawn) {
  for (const double offset : {0.0, 1e-10, 0.5, 1.0 - 1e-10}) {
    EXPECT_EQ(counts_of({0.0, 1.0, 0.0}, 100, offset), (std::vector<std::size_t>{0, 100, 0}));
    EXPECT_EQ(counts_of({0.0, 0.0, 1.0}, 100, offset), (std::vector<std::size_t>{0, 0, 100}));
    EXPECT_EQ(counts_of({1.0, 0.0, 0.0}, 100, offset), (std::vector<std::size_t>{100, 0, 0}));
  }
}

TEST(Systematic, AppendsToWhatIsThere) {
  std::vector<std::uint32_t> ancestors = {42};
  draw_systematic(cumulative_weights(log_weights({1.0, 1.0})), 2, 0.5, ancestors);
  EXPECT_EQ(ancestors, (std::vector<std::uint32_t>{42, 0, 1}));
  draw_systematic(cumulative_weights(log_weights({1.0, 1.0})), 0, 0.5, ancestors);
  EXPECT_EQ(ancestors.size(), 3u);
}

}  // namespace
}  // namespace cairn
