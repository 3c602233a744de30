#include "cairn/eval/ate.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/eval/alignment.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

Trajectory loop() {
  Trajectory poses;
  for (int i = 0; i < 40; ++i) {
    poses.push_back(
        {time_from_seconds(0.5 * i), {3 * std::cos(0.1 * i), 2 * std::sin(0.1 * i), 0.1 * i - 2}});
  }
  return poses;
}

Trajectory disturbed(Trajectory poses) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i].pose.x += 0.1 * std::sin(3.0 * double(i));
    poses[i].pose.theta = normalize_angle(poses[i].pose.theta + 0.05 * std::cos(double(i)));
  }
  return poses;
}

Ate aligned_ate(const Trajectory& reference, const Trajectory& estimate) {
  const auto pairs = associate(reference, estimate);
  return absolute_trajectory_error(aligned(pairs, rigid_alignment(pairs)));
}

TEST(Summary, OfAHandComputedSample) {
  const Summary s = summarize({4.0, 1.0, 2.0, 3.0, 10.0});
  EXPECT_EQ(s.count, 5u);
  EXPECT_DOUBLE_EQ(s.mean, 4.0);
  EXPECT_DOUBLE_EQ(s.standard_deviation, std::sqrt(50.0 / 4.0));
  EXPECT_DOUBLE_EQ(s.rms, std::sqrt(130.0 / 5.0));
  EXPECT_DOUBLE_EQ(s.median, 3.0);
  EXPECT_DOUBLE_EQ(s.p95, 4.0 + 0.8 * 6.0);
  EXPECT_DOUBLE_EQ(s.max, 10.0);
}

TEST(Summary, OfNothingAndOfOne) {
  EXPECT_EQ(summarize({}).count, 0u);
  EXPECT_EQ(summarize({}).max, 0.0);
  EXPECT_EQ(summarize({2.0}).standard_deviation, 0.0);
  EXPECT_EQ(summarize({2.0}).p95, 2.0);
  EXPECT_EQ(summarize({1.0, 2.0}).median, 1.5);
}

TEST(Ate, OfAHandComputedMiniature) {
  const std::vector<PosePair> pairs = {{time_from_seconds(0), {0, 0, kPi - 0.1}, {3, 4, -kPi + 0.1}},
                                       {time_from_seconds(1), {1, 1, 0.0}, {1, 2, -0.4}}};
  const Ate ate = absolute_trajectory_error(pairs);
  EXPECT_NEAR(ate.position_m.mean, 3.0, 1e-12);
  EXPECT_NEAR(ate.position_m.standard_deviation, std::sqrt(8.0), 1e-12);
  EXPECT_NEAR(ate.heading_rad.mean, 0.3, 1e-12);
  EXPECT_NEAR(ate.errors[0].heading_rad, 0.2, 1e-12);
  EXPECT_NEAR(ate.errors[1].heading_rad, -0.4, 1e-12);
  EXPECT_EQ(ate.errors[1].stamp, time_from_seconds(1));
}

TEST(Ate, OfATrajectoryWithItselfIsZero) {
  const Ate ate = absolute_trajectory_error(associate(loop(), loop()));
  EXPECT_EQ(ate.position_m.max, 0.0);
  EXPECT_EQ(ate.heading_rad.max, 0.0);
}

TEST(Ate, AlignedDoesNotChangeWhenTheEstimateMovesRigidly) {
  const Ate before = aligned_ate(loop(), disturbed(loop()));
  ASSERT_GT(before.position_m.mean, 0.01);
  for (const Pose2& T : {Pose2{5, -7, 0.3}, Pose2{-100, 40, -3.0}, Pose2{0, 0, kPi / 2}}) {
    Trajectory moved = disturbed(loop());
    for (auto& sample : moved) sample.pose = T * sample.pose;
    const Ate after = aligned_ate(loop(), moved);
    EXPECT_NEAR(after.position_m.mean, before.position_m.mean, 1e-9);
    EXPECT_NEAR(after.position_m.max, before.position_m.max, 1e-9);
    EXPECT_NEAR(after.heading_rad.rms, before.heading_rad.rms, 1e-9);
  }
}

}  // namespace
}  // namespace cairn
