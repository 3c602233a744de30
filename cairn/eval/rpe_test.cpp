#include "cairn/eval/rpe.hpp"

#include "cairn/core/errors.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

using std::chrono::seconds;

StampedPose at(double t, Pose2 pose) { return {time_from_seconds(t), pose}; }
Relation relation(double from, double to, Pose2 T) {
  return {time_from_seconds(from), time_from_seconds(to), T};
}

TEST(Rpe, OfAHandComputedMiniature) {
  const Trajectory estimate = {at(0, {0, 0, 0}), at(1, {1, 0, 0}), at(2, {2, 0, 0.2})};
  const std::vector<Relation> relations = {relation(0, 1, {1.3, 0.4, 0.0}), relation(1, 2, {1, 0, 0})};
  const Rpe rpe = relative_pose_error(estimate, relations);
  EXPECT_EQ(rpe.pairs, 2u);
  EXPECT_EQ(rpe.outside, 0u);
  EXPECT_NEAR(rpe.translation_rms_m, std::sqrt(0.25 / 2), 1e-12);
  EXPECT_NEAR(rpe.rotation_rms_rad, std::sqrt(0.04 / 2), 1e-12);
  EXPECT_NEAR(rpe.translation_max_m, 0.5, 1e-12);
  EXPECT_NEAR(rpe.rotation_max_rad, 0.2, 1e-12);
}

TEST(Rpe, CountsRelationsOutsideTheEstimate) {
  const std::vector<Relation> relations = {relation(-1, 0.5, {}), relation(0.5, 1.5, {}), relation(0, 1, {})};
  const Rpe rpe = relative_pose_error({at(0, {}), at(1, {})}, relations);
  EXPECT_EQ(rpe.pairs, 1u);
  EXPECT_EQ(rpe.outside, 2u);
}

TEST(Rpe, IsZeroForTheReferenceMovedRigidly) {
  Trajectory reference, moved;
  for (int i = 0; i < 30; ++i) {
    reference.push_back(at(i, {std::cos(0.3 * i), 2 * std::sin(0.2 * i), 0.1 * i - 1.5}));
    moved.push_back({reference.back().stamp, Pose2{5, -3, 2.0} * reference.back().pose});
  }
  for (const auto& relations :
       {relations_over_time(reference, seconds(3)), relations_over_distance(reference, 1.0)}) {
    ASSERT_FALSE(relations.empty());
    const Rpe rpe = relative_pose_error(moved, relations);
    EXPECT_EQ(rpe.pairs, relations.size());
    EXPECT_NEAR(rpe.translation_max_m, 0.0, 1e-12);
    EXPECT_NEAR(rpe.rotation_max_rad, 0.0, 1e-12);
  }
}

TEST(RelationsOverTime, SpanTheDelta) {
  const Trajectory reference = {at(0, {0, 0, 0}), at(1, {1, 0, 0}), at(3, {3, 0, 0})};
  const auto relations = relations_over_time(reference, seconds(2));
  ASSERT_EQ(relations.size(), 2u);
  EXPECT_NEAR(relations[0].T_from_to.x, 2.0, 1e-12);
  EXPECT_EQ(relations[1].to, time_from_seconds(3));
  EXPECT_THROW(relations_over_time(reference, seconds(0)), ConfigurationError);
}

TEST(RelationsOverDistance, EndAtTheFirstPoseFarEnough) {
  const Trajectory reference = {at(0, {0, 0, 0}), at(1, {0, 0, 0}), at(2, {0.6, 0, 0}), at(3, {1.2, 0, 0})};
  const auto relations = relations_over_distance(reference, 1.0);
  ASSERT_EQ(relations.size(), 2u);
  EXPECT_EQ(relations[0].to, time_from_seconds(3));
  EXPECT_EQ(relations[1].from, time_from_seconds(1));
  EXPECT_THROW(relations_over_distance(reference, -1.0), ConfigurationError);
  EXPECT_THROW(relations_over_distance(reference, std::nan("")), ConfigurationError);
}

}  // namespace
}  // namespace cairn
