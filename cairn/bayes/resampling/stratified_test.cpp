#include "cairn/bayes/resampling/stratified.hpp"

#include "drawn_counts.hpp"

#include <gtest/gtest.h>

namespace cairn::test {
namespace {

TEST(Stratified, OneDrawFromEachStratum) {
  Stratified scheme;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    // Strata of a quarter: two lie within the middle index, one within each of the others.
    EXPECT_EQ(drawn(scheme, cumulative_of({1.0, 2.0, 1.0}), 4, seed),
              (std::vector<std::uint32_t>{0, 1, 1, 2}));
  }
}

TEST(Stratified, WithinAStratumChanceDecides) {
  Stratified scheme;
  std::size_t first = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed)
    first += drawn(scheme, cumulative_of({1.0, 3.0}), 2, seed)[0] == 0 ? 1 : 0;
  EXPECT_NEAR(static_cast<double>(first), 500.0, 4.9 * 0.5 * std::sqrt(1000.0));  // false alarm 1e-6
}

}  // namespace
}  // namespace cairn::test
