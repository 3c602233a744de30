#include "cairn/bayes/resampling/multinomial.hpp"

#include "cairn/bayes/resampling/ascending_uniforms.hpp"
#include "drawn_counts.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace cairn::test {
namespace {

TEST(AscendingUniforms, AscendWithinTheirInterval) {
  const RandomStream random(1, RandomPurpose::kTest, 0);
  const DrawingNumbers numbers(random, 0);
  for (const std::size_t count : {1u, 10u, 100'000u}) {
    AscendingUniforms uniforms(count, numbers);
    double last = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
      const double u = uniforms.next();
      ASSERT_GE(u, last);
      last = u;
    }
    EXPECT_LE(last, 1.0);
  }
}

// Kolmogorov-Smirnov: sqrt(n) times the largest distance is above 2.69 with probability 1e-6.
TEST(AscendingUniforms, AreUniform) {
  constexpr std::size_t kCount = 20'000;
  const RandomStream random(2, RandomPurpose::kTest, 0);
  const DrawingNumbers numbers(random, 0);
  AscendingUniforms uniforms(kCount, numbers);
  double largest = 0.0;
  for (std::size_t k = 0; k < kCount; ++k) {
    const double u = uniforms.next();
    largest =
        std::max({largest, u - static_cast<double>(k) / kCount, static_cast<double>(k + 1) / kCount - u});
  }
  EXPECT_LT(std::sqrt(double{kCount}) * largest, 2.69);
}

TEST(Multinomial, EqualWeightsDoNotKeepEveryone) {
  Multinomial scheme;
  const auto counts = counts_of(drawn(scheme, cumulative_of(std::vector<double>(1000, 1.0)), 1000, 1), 1000);
  // An index is missing with probability (1 - 1/1000)^1000 = 0.3677; the number missing has a standard
  // deviation of 9.8 (occupancy problem).
  EXPECT_NEAR(static_cast<double>(std::count(counts.begin(), counts.end(), 0)), 367.7, 4.9 * 9.8);
}

}  // namespace
}  // namespace cairn::test
