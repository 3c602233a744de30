#include "cairn/models/motion/random_walk.hpp"

#include "cairn/core/angle.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

double variance_x(double seconds) {
  std::vector<Pose2> states(20'000, Pose2{1.0, 2.0, 3.1});
  RandomWalk({0.3, 0.2}, seconds).propagate({9.0, 9.0, 9.0}, states, {7, RandomPurpose::kMotion, 1});
  double sum = 0.0;
  for (const Pose2& p : states) {
    EXPECT_TRUE(p.theta >= -kPi && p.theta < kPi);
    sum += (p.x - 1.0) * (p.x - 1.0);
  }
  return sum / static_cast<double>(states.size());
}

// The variance of a sample of n has a standard deviation of sqrt(2 / n) of itself, 1 %: five of them.
TEST(RandomWalk, TheVarianceGrowsWithTime) {
  EXPECT_NEAR(variance_x(1.0), 0.09, 0.05 * 0.09);
  EXPECT_NEAR(variance_x(4.0), 0.36, 0.05 * 0.36);
}

TEST(RandomWalk, StaysWhereNoTimePasses) { EXPECT_EQ(variance_x(0.0), 0.0); }

}  // namespace
}  // namespace cairn
