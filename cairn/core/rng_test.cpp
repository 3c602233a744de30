#include "cairn/core/rng.hpp"

#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// Two-sided bound that a standard normal number exceeds with probability 1e-6: the false-alarm probability of
// every statistical check below (fixed seeds: a check that passes once passes always).
constexpr double kAlarm = 4.892;
constexpr std::uint32_t kItems = 250'000;  // blocks of four numbers
constexpr double kNumbers = 4.0 * kItems;

constexpr std::uint32_t kOnes = 0xffffffffu;

// Known answers published with the reference implementation (Random123, kat_vectors).
TEST(Philox, KnownAnswers) {
  EXPECT_EQ(philox4x32_10({0, 0, 0, 0}, {0, 0}),
            (PhiloxCounter{0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u}));
  EXPECT_EQ(philox4x32_10({kOnes, kOnes, kOnes, kOnes}, {kOnes, kOnes}),
            (PhiloxCounter{0x408f276du, 0x41c83b0eu, 0xa20bc7c6u, 0x6d5451fdu}));
  EXPECT_EQ(philox4x32_10({0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u}, {0xa4093822u, 0x299f31d0u}),
            (PhiloxCounter{0xd16cfe09u, 0x94fdccebu, 0x5001e420u, 0x24126ea1u}));
}

TEST(Philox, KnownAnswersOfSevenRounds) {
  EXPECT_EQ(philox4x32_7({0, 0, 0, 0}, {0, 0}),
            (PhiloxCounter{0x5f6fb709u, 0x0d893f64u, 0x4f121f81u, 0x4f730a48u}));
  EXPECT_EQ(philox4x32_7({kOnes, kOnes, kOnes, kOnes}, {kOnes, kOnes}),
            (PhiloxCounter{0x5207ddc2u, 0x45165e59u, 0x4d8ee751u, 0x8c52f662u}));
  EXPECT_EQ(philox4x32_7({0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u}, {0xa4093822u, 0x299f31d0u}),
            (PhiloxCounter{0x4dfccabau, 0x190a87f0u, 0xc47362bau, 0xb6b5242au}));
}

// The layout of the counter is part of every recorded result.
TEST(RandomStream, IsPhiloxOfItemDrawPurposeStepAndSeed) {
  const RandomStream random(0x1122334455667788u, RandomPurpose::kMotion, 0x99aabbccddeeff00u);
  const auto words =
      philox4x32_10({7u, (1u << 16) | 5u, 0xddeeff00u, 0x99aabbccu}, {0x55667788u, 0x11223344u});
  const auto numbers = random.uniform4(7, 5);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(numbers[k], (words[k] + 0.5) * 0x1p-32);
}

TEST(RandomStream, IsPureWhateverTheOrder) {
  const RandomStream random(1, RandomPurpose::kTest, 3);
  std::vector<std::array<double, 4>> forwards, backwards(100);
  for (std::uint32_t i = 0; i < 100; ++i) forwards.push_back(random.normal4(i));
  for (std::uint32_t i = 100; i-- > 0;) backwards[i] = RandomStream(1, RandomPurpose::kTest, 3).normal4(i);
  EXPECT_EQ(forwards, backwards);
}

TEST(RandomStream, ChunksCountTheirItemsFromTheirFirst) {
  const RandomStream random(1, RandomPurpose::kTest, 3);
  EXPECT_EQ(random.from_item(40).uniform4(2), random.uniform4(42));
  EXPECT_EQ(random.from_item(40).from_item(2).normal4(0, 9), random.normal4(42, 9));
  EXPECT_NE(random.from_item(40).uniform4(2), random.uniform4(2));
}

TEST(RandomStream, EveryArgumentGivesOtherNumbers) {
  const auto first = [](std::uint64_t seed, RandomPurpose purpose, std::uint64_t step, std::uint32_t item,
                        std::uint16_t draw) { return RandomStream(seed, purpose, step).uniform(item, draw); };
  const auto p = RandomPurpose::kTest;
  const std::set<double> different = {
      first(1, p, 1, 1, 1),          first(2, p, 1, 1, 1),
      first(1ull << 32, p, 1, 1, 1), first(1, RandomPurpose::kMotion, 1, 1, 1),
      first(1, p, 2, 1, 1),          first(1, p, 1ull << 32, 1, 1),
      first(1, p, 1, 2, 1),          first(1, p, 1, 1, 2)};
  EXPECT_EQ(different.size(), 8u);
}

TEST(RandomStream, UniformLiesStrictlyInside) {
  const RandomStream random(2, RandomPurpose::kTest, 0);
  for (std::uint32_t i = 0; i < kItems; ++i) {
    for (const double u : random.uniform4(i)) ASSERT_TRUE(u > 0.0 && u < 1.0) << u;
  }
}

// 100 cells: chi-square with 99 degrees of freedom; its quantile 1 - 1e-6 is 180.8.
TEST(RandomStream, UniformFillsItsCellsEvenly) {
  const RandomStream random(2, RandomPurpose::kTest, 1);
  std::vector<double> counts(100);
  for (std::uint32_t i = 0; i < kItems; ++i) {
    for (const double u : random.uniform4(i)) ++counts[static_cast<std::size_t>(100.0 * u)];
  }
  const double expected = kNumbers / 100.0;
  double chi_square = 0.0;
  for (const double n : counts) chi_square += (n - expected) * (n - expected) / expected;
  EXPECT_LT(chi_square, 180.8);
}

// Standard errors of the sample moments of n standard normal numbers: 1/sqrt(n), sqrt(2/n), sqrt(15/n),
// sqrt(96/n) for the moments 1 to 4 (variances E x^2k - (E x^k)^2 = 1, 2, 15, 96).
TEST(RandomStream, NormalMoments) {
  const RandomStream random(3, RandomPurpose::kTest, 0);
  std::array<double, 4> sum{};
  for (std::uint32_t i = 0; i < kItems; ++i) {
    for (const double x : random.normal4(i)) {
      double power = 1.0;
      for (double& s : sum) s += power *= x;
    }
  }
  EXPECT_NEAR(sum[0] / kNumbers, 0.0, kAlarm * std::sqrt(1.0 / kNumbers));
  EXPECT_NEAR(sum[1] / kNumbers, 1.0, kAlarm * std::sqrt(2.0 / kNumbers));
  EXPECT_NEAR(sum[2] / kNumbers, 0.0, kAlarm * std::sqrt(15.0 / kNumbers));
  EXPECT_NEAR(sum[3] / kNumbers, 3.0, kAlarm * std::sqrt(96.0 / kNumbers));
}

// The number beyond z is binomial(n, p) with p = erfc(z / sqrt 2) / 2 per side.
TEST(RandomStream, NormalTails) {
  const RandomStream random(3, RandomPurpose::kTest, 1);
  for (const double z : {1.0, 2.0, 3.0, 4.0}) {
    double above = 0.0, below = 0.0;
    for (std::uint32_t i = 0; i < kItems; ++i) {
      for (const double x : random.normal4(i)) above += x > z, below += x < -z;
    }
    const double p = 0.5 * std::erfc(z / std::sqrt(2.0));
    const double bound = kAlarm * std::sqrt(kNumbers * p * (1.0 - p)) + 1.0;
    EXPECT_NEAR(above, kNumbers * p, bound) << z;
    EXPECT_NEAR(below, kNumbers * p, bound) << z;
  }
}

// The mean of n products of independent standard normal numbers has standard deviation 1/sqrt(n).
void expect_uncorrelated(const RandomStream& a, std::size_t column_a, const RandomStream& b,
                         std::size_t column_b) {
  double products = 0.0, squares = 0.0;
  for (std::uint32_t i = 0; i < kItems; ++i) {
    const double x = a.normal4(i)[column_a], y = b.normal4(i)[column_b];
    products += x * y;
    squares += (x * x - 1.0) * (y * y - 1.0);  // variance 4
  }
  EXPECT_NEAR(products / kItems, 0.0, kAlarm / std::sqrt(kItems));
  EXPECT_NEAR(squares / kItems, 0.0, 2.0 * kAlarm / std::sqrt(kItems));
}

TEST(RandomStream, ColumnsPurposesStepsSeedsAndNeighboursAreIndependent) {
  const RandomStream random(4, RandomPurpose::kMotion, 10);
  expect_uncorrelated(random, 0, random, 1);  // the two halves of one Box-Muller pair
  expect_uncorrelated(random, 0, random, 2);
  expect_uncorrelated(random, 0, {4, RandomPurpose::kResample, 10}, 0);
  expect_uncorrelated(random, 0, {4, RandomPurpose::kMotion, 11}, 0);
  expect_uncorrelated(random, 0, {5, RandomPurpose::kMotion, 10}, 0);
  expect_uncorrelated(random, 0, random.from_item(1), 0);
}

}  // namespace
}  // namespace cairn
