#include "cairn/eval/association.hpp"

#include "cairn/core/angle.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

StampedPose at(double seconds, Pose2 pose) { return {time_from_seconds(seconds), pose}; }

TEST(Association, InterpolatesTheEstimateAtReferenceStamps) {
  const Trajectory reference = {at(1.5, {9.0, 8.0, 0.5})};
  const Trajectory estimate = {at(1.0, {0.0, 0.0, 0.0}), at(2.0, {2.0, 4.0, 1.0})};
  const auto pairs = associate(reference, estimate);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].stamp, time_from_seconds(1.5));
  EXPECT_EQ(pairs[0].reference, (Pose2{9.0, 8.0, 0.5}));
  EXPECT_NEAR(pairs[0].estimate.x, 1.0, 1e-12);
  EXPECT_NEAR(pairs[0].estimate.y, 2.0, 1e-12);
  EXPECT_NEAR(pairs[0].estimate.theta, 0.5, 1e-12);
}

TEST(Association, TurnsHeadingsTheShortWayAround) {
  const Trajectory estimate = {at(0.0, {0, 0, kPi - 0.1}), at(1.0, {0, 0, -kPi + 0.3})};
  const auto pairs = associate({at(0.5, {})}, estimate);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_NEAR(angle_difference(pairs[0].estimate.theta, -kPi + 0.1), 0.0, 1e-12);
}

TEST(Association, LeavesOutStampsBeyondTheEstimateButKeepsItsEnds) {
  const Trajectory reference = {at(0.9, {}), at(1.0, {}), at(2.0, {}), at(2.1, {})};
  const auto pairs = associate(reference, {at(1.0, {}), at(2.0, {})});
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[0].stamp, time_from_seconds(1.0));
  EXPECT_EQ(pairs[1].stamp, time_from_seconds(2.0));
}

TEST(Association, OfNothingIsEmpty) {
  EXPECT_TRUE(associate({}, {}).empty());
  EXPECT_TRUE(associate({at(1.0, {})}, {}).empty());
  EXPECT_TRUE(associate({}, {at(1.0, {})}).empty());
}

TEST(MoveInOwnFrame, MovesAlongTheHeading) {
  const auto moved = move_in_own_frame({at(1.0, {1.0, 2.0, kPi / 2})}, {0.08, 0.0, 0.0});
  EXPECT_NEAR(moved[0].pose.x, 1.0, 1e-12);
  EXPECT_NEAR(moved[0].pose.y, 2.08, 1e-12);
  EXPECT_NEAR(moved[0].pose.theta, kPi / 2, 1e-12);
}

}  // namespace
}  // namespace cairn
