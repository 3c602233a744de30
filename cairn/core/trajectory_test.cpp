#include "cairn/core/trajectory.hpp"

#include "cairn/core/angle.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

Time at(std::int64_t seconds) { return Time(Duration(seconds * 1'000'000'000)); }

const Trajectory kPath = {{at(10), {0, 0, 3.0}}, {at(12), {2, 4, -3.0}}, {at(16), {2, 8, -3.0}}};

TEST(PoseAt, StampsOfTheTrajectoryAreExact) {
  for (const StampedPose& p : kPath) EXPECT_EQ(pose_at(kPath, p.stamp), p.pose);
}

TEST(PoseAt, BetweenStampsLinearAndAlongTheShortestTurn) {
  const auto middle = pose_at(kPath, at(11));
  ASSERT_TRUE(middle);
  EXPECT_DOUBLE_EQ(middle->x, 1.0);
  EXPECT_DOUBLE_EQ(middle->y, 2.0);
  EXPECT_NEAR(middle->theta, -kPi, 1e-15);  // across the west, not through the east
  EXPECT_DOUBLE_EQ(pose_at(kPath, at(13))->y, 5.0);
}

TEST(PoseAt, OutsideThereIsNone) {
  EXPECT_EQ(pose_at(kPath, at(10) - Duration(1)), std::nullopt);
  EXPECT_EQ(pose_at(kPath, at(16) + Duration(1)), std::nullopt);
  EXPECT_EQ(pose_at({}, at(10)), std::nullopt);
}

TEST(PoseAt, OnePose) {
  const Trajectory one = {{at(5), {1, 2, 3}}};
  EXPECT_EQ(pose_at(one, at(5)), (Pose2{1, 2, 3}));
  EXPECT_EQ(pose_at(one, at(6)), std::nullopt);
}

TEST(PoseAt, ANanosecondBetweenStampsOfALargeEpoch) {
  const Time start(Duration(1'234'567'890'000'000'000));
  const Trajectory path = {{start, {0, 0, 0}}, {start + Duration(4), {4, 0, 0}}};
  EXPECT_DOUBLE_EQ(pose_at(path, start + Duration(1))->x, 1.0);
}

TEST(SortByStamp, SortsAndKeepsTheFirstOfEqualStamps) {
  Trajectory path = {{at(3), {3, 0, 0}}, {at(1), {1, 0, 0}},  {at(3), {30, 0, 0}},
                     {at(2), {2, 0, 0}}, {at(1), {10, 0, 0}}, {at(3), {300, 0, 0}}};
  EXPECT_EQ(sort_by_stamp(path), 3u);
  EXPECT_EQ(path, (Trajectory{{at(1), {1, 0, 0}}, {at(2), {2, 0, 0}}, {at(3), {3, 0, 0}}}));
}

TEST(SortByStamp, LeavesAStrictlyIncreasingOneAlone) {
  Trajectory path = kPath;
  EXPECT_EQ(sort_by_stamp(path), 0u);
  EXPECT_EQ(path, kPath);
  Trajectory none;
  EXPECT_EQ(sort_by_stamp(none), 0u);
}

TEST(PathLength, IsTheSumOfTheSteps) {
  EXPECT_DOUBLE_EQ(path_length(kPath), std::sqrt(20.0) + 4.0);
  EXPECT_EQ(path_length({}), 0.0);
  EXPECT_EQ(path_length({kPath.front()}), 0.0);
}

}  // namespace
}  // namespace cairn
