#include "cairn/sim/wheel_odometry.hpp"

#include "cairn/core/errors.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr WheelOdometryOptions kPerfect{
    .sigma_wheel_radius = 0.0, .sigma_wheel_base = 0.0, .sigma_per_sqrt_metre_m = 0.0, .every = 1};

// `steps` poses along an arc of constant twist.
Trajectory arc(const Pose2& start, const Twist2& step, int steps) {
  Trajectory path{{Time{}, start}};
  for (int i = 0; i < steps; ++i) {
    path.push_back({path.back().stamp + std::chrono::milliseconds(20), path.back().pose * exp(step)});
  }
  return path;
}

TEST(WheelOdometry, WithoutErrorsTellsTheTruePathFromItsStart) {
  const Trajectory truth = arc({3.0, -1.0, 2.0}, {0.02, 0.0, 0.01}, 500);
  const auto told = simulate_wheel_odometry(truth, kPerfect, 1);
  ASSERT_EQ(told.size(), truth.size());
  for (std::size_t i = 0; i < told.size(); ++i) {
    EXPECT_EQ(told[i].stamp, truth[i].stamp);
    EXPECT_LT(distance(told[i].T_odom_base, between(truth.front().pose, truth[i].pose)), 1e-9);
  }
}

TEST(WheelOdometry, TellsEveryNthPose) {
  WheelOdometryOptions options = kPerfect;
  options.every = 3;
  const auto told = simulate_wheel_odometry(arc({}, {0.02, 0.0, 0.0}, 10), options, 1);
  ASSERT_EQ(told.size(), 4U);
  EXPECT_NEAR(told.back().T_odom_base.x, 0.18, 1e-9);
}

TEST(WheelOdometry, RandomErrorGrowsWithTheSquareRootOfTheWay) {
  WheelOdometryOptions options = kPerfect;
  options.sigma_per_sqrt_metre_m = 0.01;
  const Trajectory truth = arc({}, {0.02, 0.0, 0.0}, 450);  // 9 m
  double sum_of_squares = 0.0;
  constexpr int kRuns = 400;
  for (int seed = 0; seed < kRuns; ++seed) {
    const double turned =
        simulate_wheel_odometry(truth, options, static_cast<std::uint64_t>(seed)).back().T_odom_base.theta;
    sum_of_squares += turned * turned;
  }
  // Heading error: difference of two wheels' errors (0.01 m * sqrt(9)) over the wheel base.
  const double expected = std::sqrt(2.0) * 0.03 / options.wheel_base_m;
  // 400 runs tell a standard deviation to 3.5 % (1 sigma); 20 % is beyond five of them.
  EXPECT_NEAR(std::sqrt(sum_of_squares / kRuns) / expected, 1.0, 0.2);
}

TEST(WheelOdometry, SystematicErrorsAreConstantFactors) {
  WheelOdometryOptions options = kPerfect;
  options.sigma_wheel_base = 0.01;
  const auto told = simulate_wheel_odometry(arc({}, {0.0, 0.0, 0.001}, 1000), options, 3);
  const double half = told[500].T_odom_base.theta;
  const double whole = told[1000].T_odom_base.theta;
  EXPECT_NEAR(whole, 2.0 * half, 1e-9);
  EXPECT_GT(std::abs(whole - 1.0), 1e-5);
  EXPECT_LT(std::abs(whole - 1.0), 0.06);
}

TEST(WheelOdometry, RefusesOptionsOutOfRange) {
  EXPECT_THROW(simulate_wheel_odometry({}, {.wheel_base_m = 0.0}, 1), ConfigurationError);
  EXPECT_THROW(simulate_wheel_odometry({}, {.sigma_wheel_base = -1.0}, 1), ConfigurationError);
  EXPECT_THROW(simulate_wheel_odometry({}, {.every = 0}, 1), ConfigurationError);
}

}  // namespace
}  // namespace cairn
