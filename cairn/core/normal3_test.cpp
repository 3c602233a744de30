#include "cairn/core/normal3.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// How many of the 2^24 cases give each number.
const std::map<int, std::uint64_t>& cases() {
  static const std::map<int, std::uint64_t> made = [] {
    std::map<int, std::uint64_t> sums = {{0, 1}};  // of the tables so far
    for (const Normal3::Table& table : Normal3::kTables) {
      std::map<int, std::uint64_t> longer;
      for (const auto& [sum, ways] : sums)
        for (const int value : table) longer[sum + value] += ways;
      sums = longer;
    }
    std::map<int, std::uint64_t> numbers;
    for (const auto& [sum, ways] : sums)
      for (int fraction = 0; fraction < 16; ++fraction) numbers[256 * sum + 16 * fraction + 8] += ways;
    return numbers;
  }();
  return made;
}

constexpr double kCases = 1 << 24;

// The p-th moment, in standard deviations.
double moment(int p) {
  double sum = 0.0;
  for (const auto& [number, ways] : cases())
    sum += static_cast<double>(ways) / kCases * std::pow(number * Normal3::kUnit, p);
  return sum;
}

double share_above(double z) {
  double ways_above = 0.0;
  for (const auto& [number, ways] : cases())
    ways_above += number * Normal3::kUnit > z ? static_cast<double>(ways) : 0.0;
  return ways_above / kCases;
}

double normal_above(double z) { return 0.5 * std::erfc(z / std::sqrt(2.0)); }

TEST(Normal3, SumsFitInSixteenBits) {
  EXPECT_GT(cases().begin()->first, -32768);
  EXPECT_LT(cases().rbegin()->first, 32768);
}

TEST(Normal3, IsSymmetric) {
  for (const auto& [number, ways] : cases()) {
    const auto mirrored = cases().find(-number);
    ASSERT_NE(mirrored, cases().end()) << number;
    ASSERT_EQ(mirrored->second, ways) << number;
  }
}

TEST(Normal3, MomentsAreThoseOfTheNormalDistribution) {
  EXPECT_NEAR(moment(2), 1.0, 1e-9);
  EXPECT_NEAR(moment(4), 3.0, 3.0 * 4e-5);
  EXPECT_NEAR(moment(6), 15.0, 15.0 * 2e-3);
  EXPECT_NEAR(moment(8), 105.0, 105.0 * 9e-3);
}

TEST(Normal3, DistributionFunctionAndTails) {
  // In the middle between two numbers.
  for (int between = 0; between < 32768; between += 16) {
    const double z = between * Normal3::kUnit;
    ASSERT_NEAR(share_above(z), normal_above(z), 1e-4) << z;
  }
  EXPECT_NEAR(share_above(2.0) / normal_above(2.0), 1.0, 0.005);
  EXPECT_NEAR(share_above(3.0) / normal_above(3.0), 1.0, 0.03);
  EXPECT_NEAR(share_above(4.0) / normal_above(4.0), 1.0, 0.15);
  EXPECT_NEAR(share_above(4.5) / normal_above(4.5), 0.56, 0.01);  // what 2^20 sums have left so far out
}

// Every case is as likely as any other: the bytes of all items are other bytes of the group.
TEST(Normal3, EveryByteOfAGroupBelongsToOneItem) {
  std::set<std::size_t> columns;
  for (std::size_t i = 0; i < Normal3::kGroup; ++i) columns.insert(Normal3::column_of(i));
  EXPECT_EQ(columns.size(), Normal3::kGroup);
  EXPECT_LT(*columns.rbegin(), Normal3::kGroup);
  std::set<std::array<std::size_t, 3>> places;
  for (std::size_t k = 0; k < Normal3::kBytes; ++k) {
    const Normal3::Place p = Normal3::place_of(k);
    EXPECT_LT(p.step, Normal3::kSteps);
    EXPECT_LT(p.generator, Normal3::kGenerators);
    places.insert({p.step, p.generator, static_cast<std::size_t>(p.shift)});
  }
  EXPECT_EQ(places.size(), Normal3::kBytes);
}

TEST(Normal3, AnItemDrawsFromOneGenerator) {
  for (std::size_t i = 0; i < Normal3::kGroup; ++i) {
    const std::size_t column = Normal3::column_of(i);
    for (std::size_t row = 0; row < 9; ++row)
      EXPECT_EQ(Normal3::place_of(row * Normal3::kGroup + column).generator,
                Normal3::place_of(column).generator);
  }
}

// Generators that share a word of their start would be related.
TEST(Normal3, EveryPairOfWordsStartsOneGenerator) {
  std::array<PhiloxCounter, Normal3::kBlocks> blocks;
  std::uint32_t word = 0;
  for (PhiloxCounter& block : blocks)
    for (std::uint32_t& w : block) w = word++;
  std::set<std::uint64_t> starts;
  for (std::size_t g = 0; g < Normal3::kGenerators; ++g) {
    const Sfc64 s = Normal3::generator(blocks, g);
    starts.insert({s.a, s.b, s.c});
    EXPECT_EQ(s.counter, 1u);
  }
  EXPECT_EQ(starts.size(), 3 * Normal3::kGenerators);
}

}  // namespace
}  // namespace cairn
