#include "cairn/core/pose2.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/rng.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// Identity, tiny, degenerate (half turns, the border of the heading, far away) and random ones.
std::vector<Pose2> sample_poses() {
  std::vector<Pose2> poses = {
      {0, 0, 0},         {1e-12, -1e-12, 1e-12}, {1, 2, 1e-6},      {1, 2, 2e-5},
      {0, 0, -kPi},      {3, -1, kPi / 2},       {-2, 5, -kPi / 2}, {1, 1, std::nextafter(kPi, 0.0)},
      {1000, -2000, 3.0}};
  const RandomStream random(1, RandomPurpose::kTest, 0);
  for (std::uint32_t i = 0; i < 20; ++i) {
    const auto u = random.uniform4(i);
    poses.push_back({20.0 * u[0] - 10.0, 20.0 * u[1] - 10.0, normalize_angle(kTwoPi * u[2])});
  }
  return poses;
}

void expect_near(const Pose2& a, const Pose2& b, double tolerance = 1e-11) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(angle_difference(a.theta, b.theta), 0.0, 1e-14);
}

TEST(Pose2, QuarterTurnByHand) {
  const Pose2 T_a_b{1.0, 2.0, kPi / 2.0};
  const Point2 p_a = T_a_b * Point2{3.0, 4.0};
  EXPECT_NEAR(p_a.x, 1.0 - 4.0, 1e-15);
  EXPECT_NEAR(p_a.y, 2.0 + 3.0, 1e-15);
  expect_near(T_a_b * Pose2{3.0, 4.0, kPi / 2.0}, {-3.0, 5.0, -kPi});
}

TEST(Pose2, IdentityIsNeutral) {
  for (const Pose2& T : sample_poses()) {
    EXPECT_EQ(Pose2{} * T, T);
    EXPECT_EQ(T * Pose2{}, T);
  }
}

TEST(Pose2, InverseUndoes) {
  for (const Pose2& T : sample_poses()) {
    expect_near(T * inverse(T), {});
    expect_near(inverse(T) * T, {});
  }
}

TEST(Pose2, CompositionIsAssociative) {
  const auto poses = sample_poses();
  for (std::size_t i = 0; i + 2 < poses.size(); ++i) {
    expect_near((poses[i] * poses[i + 1]) * poses[i + 2], poses[i] * (poses[i + 1] * poses[i + 2]));
  }
}

TEST(Pose2, CompositionActsOnPointsOneAfterTheOther) {
  const auto poses = sample_poses();
  const Point2 p{0.7, -1.3};
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    const Point2 at_once = (poses[i] * poses[i + 1]) * p;
    const Point2 in_turn = poses[i] * (poses[i + 1] * p);
    EXPECT_NEAR(at_once.x, in_turn.x, 1e-11);
    EXPECT_NEAR(at_once.y, in_turn.y, 1e-11);
  }
}

TEST(Pose2, HeadingsStayInTheirInterval) {
  for (const Pose2& a : sample_poses()) {
    for (const Pose2& b : sample_poses()) {
      for (const double theta : {(a * b).theta, inverse(a).theta, between(a, b).theta}) {
        EXPECT_TRUE(theta >= -kPi && theta < kPi) << theta;
      }
    }
  }
}

TEST(Pose2, BetweenLeadsFromOneToTheOther) {
  for (const Pose2& from : sample_poses()) {
    for (const Pose2& to : sample_poses()) expect_near(from * between(from, to), to, 1e-10);
  }
}

TEST(Pose2, ExpUndoesLog) {
  for (const Pose2& T : sample_poses()) expect_near(exp(log(T)), T);
}

TEST(Pose2, LogUndoesExp) {
  for (const Twist2& t : {Twist2{1, 2, 3}, Twist2{1, -2, -3}, Twist2{1, 2, 1e-9}, Twist2{0, 0, 2}}) {
    const Twist2 back = log(exp(t));
    EXPECT_NEAR(back.x, t.x, 1e-14);
    EXPECT_NEAR(back.y, t.y, 1e-14);
    EXPECT_NEAR(back.theta, t.theta, 1e-14);
  }
}

TEST(Pose2, ExpIsTheArc) {
  expect_near(exp({kPi / 2.0, 0.0, kPi / 2.0}), {1.0, 1.0, kPi / 2.0}, 1e-15);  // a quarter of radius 1
  EXPECT_EQ(exp({3.0, -4.0, 0.0}), (Pose2{3.0, -4.0, 0.0}));
}

// (1 - cos a) / a loses half its digits for small angles; a/2 - a^3/24 does not.
TEST(Pose2, ExpIsExactForSmallTurns) {
  for (const double a : {1e-9, 0.9e-5, 1.1e-5, 1e-4, -1e-4, 1e-3}) {
    const Pose2 T = exp({1.0, 0.0, a});
    EXPECT_NEAR(T.x, 1.0 - a * a / 6.0, 1e-13) << a;
    EXPECT_NEAR(T.y, a / 2.0 - a * a * a / 24.0, 1e-17 + 1e-12 * a * a) << a;
  }
}

TEST(Pose2, InterpolationMeetsItsEndsAndHalvesTheArc) {
  for (const Pose2& from : sample_poses()) {
    for (const Pose2& to : sample_poses()) {
      expect_near(interpolate(from, to, 0.0), from, 1e-10);
      expect_near(interpolate(from, to, 1.0), to, 1e-10);
    }
  }
  const double half = std::sqrt(0.5);
  expect_near(interpolate({0, 0, 0}, {1, 1, kPi / 2.0}, 0.5), {half, 1.0 - half, kPi / 4.0}, 1e-15);
}

TEST(Pose2, InterpolationDoesNotDependOnTheFrame) {
  const Pose2 a{1, 2, 3}, b{2, 1, -3}, T{5, -4, 2};
  expect_near(interpolate(T * a, T * b, 0.3), T * interpolate(a, b, 0.3));
}

TEST(Pose2, ExtrapolationGoesOnAlongTheArc) {
  expect_near(interpolate({0, 0, 0}, {1, 1, kPi / 2.0}, 2.0), {0.0, 2.0, -kPi}, 1e-14);
}

TEST(Pose2, DistanceAndFiniteness) {
  EXPECT_EQ(distance({1, 1, 0}, {4, 5, 2}), 5.0);
  EXPECT_TRUE(is_finite(Pose2{1e300, 0, 0}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Pose2& bad : {Pose2{nan, 0, 0}, Pose2{0, infinity, 0}, Pose2{0, 0, nan}}) {
    EXPECT_FALSE(is_finite(bad));
  }
}

}  // namespace
}  // namespace cairn
