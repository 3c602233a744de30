#include "cairn/eval/paired_comparison.hpp"

#include "cairn/core/rng.hpp"

#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(PairedComparison, DifferenceIsBMinusA) {
  const PairedComparison result = compare_paired(std::vector{1.0, 5.0, 9.0}, std::vector{0.5, 4.0, 8.5});
  EXPECT_EQ(result.difference.count, 3U);
  EXPECT_NEAR(result.difference.mean, -2.0 / 3.0, 1e-15);
  EXPECT_LT(result.difference.high, 0.0);
}

// All differences on one side: only the two ways with all signs alike are as far, 2 of 2^n.
TEST(PairedComparison, ExactPValueByHand) {
  EXPECT_DOUBLE_EQ(compare_paired(std::vector{0.0}, std::vector{1.0}).p_value, 1.0);
  EXPECT_DOUBLE_EQ(compare_paired(std::vector{0.0, 0.0, 0.0}, std::vector{1.0, 2.0, 4.0}).p_value, 0.25);
  const std::vector<double> zeros(10, 0.0);
  const std::vector<double> ones(10, 1.0);
  EXPECT_DOUBLE_EQ(compare_paired(zeros, ones).p_value, 2.0 / 1024.0);
  // 1 - 2 + 4 = 3: of the eight signed sums (+-1, +-3, +-5, +-7) six are at least that far from 0.
  EXPECT_DOUBLE_EQ(compare_paired(std::vector{0.0, 2.0, 0.0}, std::vector{1.0, 0.0, 4.0}).p_value, 0.75);
}

TEST(PairedComparison, NoDifferenceHasPOfOne) {
  const std::vector<double> values{0.3, 0.1, 0.7};
  EXPECT_DOUBLE_EQ(compare_paired(values, values).p_value, 1.0);
  EXPECT_DOUBLE_EQ(compare_paired({}, {}).p_value, 1.0);
}

// What differs between inputs falls out: a small gain is seen under a spread a thousand times as large.
TEST(PairedComparison, SeesAGainBelowTheSpreadOfTheInputs) {
  std::vector<double> a;
  std::vector<double> b;
  const RandomStream random(5, RandomPurpose::kTest, 0);
  for (std::uint32_t i = 0; i < 30; ++i) {
    a.push_back(1000.0 * random.uniform(i));
    b.push_back(a.back() - 1.0 + 0.5 * random.normal4(i, 1)[0]);
  }
  const PairedComparison result = compare_paired(a, b);
  EXPECT_NEAR(result.difference.mean, -1.0, 0.5);
  EXPECT_LT(result.difference.high, 0.0);
  EXPECT_LT(result.p_value, 1e-3);
}

// Where there is no difference p is uniform: of 400 comparisons about 20 have p <= 0.05. Binomial, alpha
// 1e-6: at most 45.
TEST(PairedComparison, FalseAlarmsAreAsRareAsTheyShould) {
  int alarms = 0;
  for (std::uint64_t step = 1; step <= 400; ++step) {
    const RandomStream random(11, RandomPurpose::kTest, step);
    std::vector<double> a, b;
    for (std::uint32_t i = 0; i < 20; ++i) {
      a.push_back(random.normal4(i, 0)[0]);
      b.push_back(random.normal4(i, 1)[0]);
    }
    alarms += compare_paired(a, b, {.resamples = 300}).p_value <= 0.05 ? 1 : 0;
  }
  EXPECT_LE(alarms, 45);
  EXPECT_GE(alarms, 2);
}

TEST(PairedComparison, UnequalSizesAreABug) {
  EXPECT_THROW(compare_paired(std::vector{1.0}, std::vector{1.0, 2.0}), std::logic_error);
}

}  // namespace
}  // namespace cairn
