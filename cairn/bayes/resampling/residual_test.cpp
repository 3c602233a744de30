#include "cairn/bayes/resampling/residual.hpp"

#include "drawn_counts.hpp"

#include <gtest/gtest.h>

namespace cairn::test {
namespace {

using Counts = std::vector<std::size_t>;

TEST(Residual, WholeCopiesAreCertain) {
  Residual scheme;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    EXPECT_EQ(counts_of(drawn(scheme, cumulative_of({1.0, 3.0, 4.0}), 8, seed), 3), (Counts{1, 3, 4}));
    // Thirds are no binary fractions; three of them are one copy all the same.
    EXPECT_EQ(counts_of(drawn(scheme, cumulative_of({1.0, 1.0, 1.0}), 3, seed), 3), (Counts{1, 1, 1}));
  }
}

TEST(Residual, TheFractionsAreLeftToChance) {
  Residual scheme;
  std::size_t to_first = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    // 10 * (0.23, 0.77): two and seven copies, the last one by 0.3 to 0.7.
    const Counts counts = counts_of(drawn(scheme, cumulative_of({23.0, 77.0}), 10, seed), 2);
    ASSERT_GE(counts[0], 2u);
    ASSERT_GE(counts[1], 7u);
    to_first += counts[0] - 2;
  }
  EXPECT_NEAR(static_cast<double>(to_first), 300.0, 4.9 * std::sqrt(1000.0 * 0.21));  // false alarm 1e-6
}

}  // namespace
}  // namespace cairn::test
