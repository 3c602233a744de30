#include "cairn/bayes/resampling/wheel_of_fortune.hpp"

#include "drawn_counts.hpp"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

namespace cairn::test {
namespace {

// The wheel turned by hand: subtract weights until the turn is used up.
std::vector<std::uint32_t> turned_by_hand(const std::vector<double>& weights, const DrawingNumbers& numbers,
                                          std::size_t count) {
  const double largest = *std::max_element(weights.begin(), weights.end());
  std::vector<std::uint32_t> ancestors;
  double left = numbers.start();
  std::size_t i = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    left += 2.0 * largest * numbers.of_particle(k);
    for (; left >= weights[i]; i = (i + 1) % weights.size()) left -= weights[i];
    ancestors.push_back(static_cast<std::uint32_t>(i));
  }
  return ancestors;
}

TEST(WheelOfFortune, IsTheWheelTurnedByHand) {
  WheelOfFortune scheme;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    std::vector<double> weights = uneven_weights(40, seed);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (double& w : weights) w /= total;
    const RandomStream random(seed, RandomPurpose::kResample, 0);
    EXPECT_EQ(drawn(scheme, cumulative_of(weights), 60, seed),
              turned_by_hand(weights, DrawingNumbers(random, 0), 60));
  }
}

}  // namespace
}  // namespace cairn::test
