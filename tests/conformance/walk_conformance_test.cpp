#include "motion_models.hpp"

#include <gtest/gtest.h>

namespace cairn::test {
namespace {

const RandomStream kRandom(1, RandomPurpose::kTest, 0);

/// The laws of motion models whose control is the time that passes.
template <typename Walk>
class WalkLaws : public ::testing::Test {
 protected:
  using States = std::vector<typename Walk::State>;
  Walk walk;

  States walked(double seconds, std::size_t n) const {
    States states(n, walk.start);
    walk.propagate(seconds, states, kRandom);
    return states;
  }
  double mean_square(double seconds, std::size_t n) const {
    double sum = 0.0;
    for (const auto& state : walked(seconds, n)) sum += walk.squared_distance(state, walk.start);
    return sum / static_cast<double>(n);
  }
};

using Walks = ::testing::Types<PoseWalk, SurfaceWalk>;
TYPED_TEST_SUITE(WalkLaws, Walks);

TYPED_TEST(WalkLaws, StatesStayValid) {
  for (const double seconds : {0.0, 0.01, 1.0, 1000.0})
    for (const auto& state : this->walked(seconds, 2000)) ASSERT_TRUE(this->walk.is_valid(state)) << seconds;
}

TYPED_TEST(WalkLaws, IndependentOfChunksAndPure) {
  const auto whole = this->walked(1.0, 1000);
  EXPECT_EQ(whole, this->walked(1.0, 1000));
  typename TestFixture::States pieces(1000, this->walk.start);
  for (std::uint32_t begin = 0; begin < 1000; begin += 40)
    this->walk.propagate(1.0, std::span(pieces).subspan(begin, 40), kRandom.from_item(begin));
  EXPECT_EQ(whole, pieces);
  EXPECT_FALSE(whole[0] == whole[1]);  // each particle strays on its own
}

// The mean of n squares of a plane's normal step has a standard deviation of 1 / sqrt(n) of itself; the ratio
// of two of sqrt(2 / n): 4.9 of them (false alarm 1e-6).
TYPED_TEST(WalkLaws, TheVarianceGrowsWithTheTime) {
  constexpr std::size_t kSamples = 20'000;
  EXPECT_NEAR(this->mean_square(4.0, kSamples) / this->mean_square(1.0, kSamples) / 4.0, 1.0,
              4.9 * std::sqrt(2.0 / kSamples));
}

TYPED_TEST(WalkLaws, NobodyStraysInNoTime) { EXPECT_LT(this->mean_square(0.0, 100), 1e-24); }

TYPED_TEST(WalkLaws, NoStatesAreNoTrouble) { EXPECT_TRUE(this->walked(1.0, 0).empty()); }

}  // namespace
}  // namespace cairn::test
