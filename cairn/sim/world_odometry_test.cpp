#include "cairn/sim/world_odometry.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

WorldOdometryOptions perfect() {
  WorldOdometryOptions options;
  options.sigma_wheel_radius = options.sigma_wheel_base = 0.0;
  options.sigma_per_sqrt_metre_m = options.sigma_per_sqrt_metre_rad = 0.0;
  return options;
}

RobotDrive arc() {
  RobotDrive drive;
  Pose2 pose{3.0, 2.0, 0.7};
  for (int i = 0; i <= 1000; ++i) {
    drive.truth.push_back({Time{} + i * std::chrono::milliseconds(20), pose});
    pose = pose * exp({0.02, 0.0, 0.004});
  }
  return drive;
}

Pose2 last(const WorldOdometryOptions& options, const RobotDrive& drive = arc(), std::uint64_t seed = 1) {
  return simulate_world_odometry(drive, options, seed).back().T_odom_base;
}

TEST(WorldOdometry, WithoutErrorsIsTheTruth) {
  const RobotDrive drive = arc();
  const Pose2 truth = between(drive.truth.front().pose, drive.truth.back().pose);
  const Pose2 told = last(perfect());
  EXPECT_NEAR(told.x, truth.x, 1e-9);
  EXPECT_NEAR(told.y, truth.y, 1e-9);
  EXPECT_NEAR(told.theta, truth.theta, 1e-9);
}

TEST(WorldOdometry, EachErrorShows) {
  const Pose2 truth = last(perfect());
  const auto change = [&](auto edit) {
    WorldOdometryOptions options = perfect();
    edit(options);
    return distance(last(options), truth);
  };
  EXPECT_GT(change([](auto& o) { o.sigma_wheel_radius = 0.01; }), 0.01);
  EXPECT_GT(change([](auto& o) { o.sigma_wheel_base = 0.01; }), 0.01);
  EXPECT_GT(change([](auto& o) { o.sigma_per_sqrt_metre_m = 0.01; }), 0.001);
  EXPECT_GT(change([](auto& o) { o.slip_every_m = 2.0; }), 0.2);
  EXPECT_GT(change([](auto& o) { o.bump_every_s = 1.0; }), 0.01);
  EXPECT_GT(change([](auto& o) { o.reversed = true; }), 5.0);
}

TEST(WorldOdometry, SlippingWheelsTellTooMuch) {
  RobotDrive straight;
  for (int i = 0; i <= 1000; ++i)
    straight.truth.push_back({Time{} + i * std::chrono::milliseconds(20), {0.02 * i, 0.0, 0.0}});
  WorldOdometryOptions options = perfect();
  options.slip_every_m = 3.0;
  EXPECT_GT(last(options, straight).x, 20.3);
}

TEST(WorldOdometry, AKidnappingIsNotSeen) {
  RobotDrive drive = arc();
  for (std::size_t i = 500; i < drive.truth.size(); ++i)
    drive.truth[i].pose = Pose2{50.0, 0.0, 0.0} * drive.truth[i].pose;
  drive.kidnapped_to = 500;
  EXPECT_LT(distance(last(perfect(), drive), last(perfect())), 0.05);
}

TEST(WorldOdometry, TellsTheSystematicErrorsItIsGiven) {
  WorldOdometryOptions options = perfect();
  options.distance_factor = 1.02;
  options.turn_factor = 0.98;
  options.drift_rad_per_m = -0.03;
  RobotDrive step;
  step.truth = {{Time{}, {}}, {time_from_seconds(0.02), exp({0.5, 0.0, 0.2})}};
  const Twist2 told = log(last(options, step));
  EXPECT_NEAR(told.x, 1.02 * 0.5, 1e-9);
  EXPECT_NEAR(told.theta, 0.98 * 0.2 - 0.03 * 0.5, 1e-9);
}

}  // namespace
}  // namespace cairn
