#include "cairn/bayes/sample_size.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// n poses, each in a bin of its own.
std::vector<Pose2> spread(int n, double start_m = 0.25) {
  std::vector<Pose2> poses;
  for (int i = 0; i < n; ++i) poses.push_back({start_m + 0.5 * i, 0.25, 0.05});
  return poses;
}

TEST(FixedSize, NeverChanges) {
  FixedSize<int> size(17);
  EXPECT_EQ(size.begin(), 17u);
  EXPECT_EQ(size.most(), 17u);
  EXPECT_EQ(size.wanted(std::vector<int>(1000)), 17u);
}

TEST(KldSize, FollowsTheOccupiedBins) {
  KldSize size({}, 10, 100'000);
  EXPECT_EQ(size.begin(), 10u);
  EXPECT_EQ(size.wanted(spread(50)), kld_bound(50, {}));
  EXPECT_EQ(size.wanted(spread(50)), kld_bound(50, {}));           // the same bins again
  EXPECT_EQ(size.wanted(spread(30, 1000.25)), kld_bound(80, {}));  // more
}

TEST(KldSize, ForgetsTheLastGeneration) {
  KldSize size({}, 10, 100'000);
  size.begin();
  size.wanted(spread(50));
  size.begin();
  EXPECT_EQ(size.wanted(spread(5)), kld_bound(5, {}));
}

TEST(KldSize, StaysWithinItsLimits) {
  KldSize size({}, 100, 400);
  EXPECT_EQ(size.begin(), 100u);
  EXPECT_EQ(size.most(), 400u);
  EXPECT_EQ(size.wanted(spread(2)), 100u);
  EXPECT_EQ(size.wanted(spread(500)), 400u);
}

}  // namespace
}  // namespace cairn
