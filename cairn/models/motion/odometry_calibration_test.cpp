#include "cairn/models/motion/odometry_calibration.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/core/rng.hpp"
#include "cairn/models/motion/noisy_move.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr double kBase_m = 0.4;

// How the robot of these tests drives: every other motion an arc, the others straight or on the spot.
Twist2 true_motion(std::uint32_t i) {
  const auto u = RandomStream(3, RandomPurpose::kTest, 1).uniform4(i);
  if (i % 4 == 0) return {0.0, 0.0, u[0] < 0.5 ? 0.1 : -0.1};
  return {0.1, 0.0, i % 2 == 0 ? 0.0 : 0.2 * (u[0] - 0.5)};
}

struct Wheels {
  double distance = 1.0, turn = 1.0, drift_rad_per_m = 0.0;
  double per_sqrt_m = 0.005, per_sqrt_m_rad = 0.004;
  double reference_m = 0.0, reference_rad = 0.0;  // white noise of the reference's poses
  double slips = 0.0;                             // share of motions with eight times the noise
};

std::vector<MotionChain> drive(const Wheels& wheels, std::uint32_t count, std::uint64_t seed) {
  MotionChain chain;
  const RandomStream random(seed, RandomPurpose::kTest, 0);
  const auto noisy = [&](const Pose2& pose, std::uint32_t i) {
    const auto n = random.normal4(i, 1);
    return pose * Pose2{wheels.reference_m * n[0], wheels.reference_m * n[1], wheels.reference_rad * n[2]};
  };
  Pose2 pose;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Twist2 moved = true_motion(i);
    const double way = std::abs(moved.x) + 0.5 * kBase_m * std::abs(moved.theta);
    const auto n = random.normal4(i);
    const double noise = std::sqrt(way) * (random.uniform(i, 2) < wheels.slips ? 8.0 : 1.0);
    const Twist2 told{
        wheels.distance * moved.x + wheels.per_sqrt_m * noise * n[0], 0.0,
        wheels.turn * moved.theta + wheels.drift_rad_per_m * moved.x + wheels.per_sqrt_m_rad * noise * n[1]};
    const Pose2 next = pose * exp(moved);
    chain.push_back({exp(told), between(noisy(pose, i), noisy(next, i + 1))});
    pose = next;
  }
  return {chain};
}

// The standard errors are those of the calibration itself, from 24 resamples: a ratio beyond six has a
// false-alarm probability of 4e-6 (t distribution with 23 degrees of freedom).
void expect_near(const Estimated& found, double truth, const char* what) {
  EXPECT_NEAR(found.value, truth, 6.0 * found.error) << what;
}

void expect_recovered(const Wheels& wheels, const OdometryCalibration& found) {
  expect_near(found.distance_factor, wheels.distance, "distance");
  expect_near(found.turn_factor, wheels.turn, "turn");
  expect_near(found.drift_rad_per_m, wheels.drift_rad_per_m, "drift");
  expect_near(found.sigma_per_sqrt_metre_m, wheels.per_sqrt_m, "metres");
  expect_near(found.sigma_per_sqrt_metre_rad, wheels.per_sqrt_m_rad, "radians");
}

TEST(OdometryCalibration, FindsSystematicAndRandomErrors) {
  const Wheels wheels{.distance = 1.02, .turn = 0.97, .drift_rad_per_m = 0.01};
  const OdometryCalibration found =
      calibrate_odometry(drive(wheels, 3000, 1), {.wheel_base_m = kBase_m, .resamples = 24});
  expect_recovered(wheels, found);
  EXPECT_EQ(found.motions, 3000U);
  // The errors are small enough to be of use.
  EXPECT_LT(found.distance_factor.error, 0.002);
  EXPECT_LT(found.turn_factor.error, 0.008);
  EXPECT_LT(found.sigma_per_sqrt_metre_m.error, 0.0005);
  EXPECT_LT(found.sigma_per_sqrt_metre_rad.error, 0.0005);
}

TEST(OdometryCalibration, TellsTheNoiseOfTheReferenceFromThatOfTheWheels) {
  const Wheels wheels{.distance = 0.99, .reference_m = 0.01, .reference_rad = 0.002};
  const OdometryCalibration found =
      calibrate_odometry(drive(wheels, 3000, 2), {.wheel_base_m = kBase_m, .resamples = 24});
  expect_recovered(wheels, found);
  expect_near(found.sigma_constant_rad, std::sqrt(2.0) * wheels.reference_rad, "constant radians");
  expect_near(found.sigma_constant_m, std::sqrt(2.0) * wheels.reference_m, "constant metres");
}

TEST(OdometryCalibration, SlipsHardlyMoveIt) {
  const Wheels wheels{.distance = 1.01, .slips = 0.02};
  const OdometryCalibration found =
      calibrate_odometry(drive(wheels, 3000, 3), {.wheel_base_m = kBase_m, .resamples = 24});
  expect_near(found.distance_factor, wheels.distance, "distance");
  // The plain estimate would be 1.5 times too large: sqrt(1 + 0.02 (64 - 1)).
  EXPECT_NEAR(found.sigma_per_sqrt_metre_m.value, wheels.per_sqrt_m, 0.1 * wheels.per_sqrt_m);
  EXPECT_GT(found.outlier_share, 0.01);
}

TEST(OdometryCalibration, StandardErrorsAreThoseOfRepeatedDrives) {
  constexpr int kDrives = 25;
  const Wheels wheels{.distance = 1.02};
  double sum = 0.0, squares = 0.0, told = 0.0;
  for (int i = 0; i < kDrives; ++i) {
    const auto found = calibrate_odometry(drive(wheels, 1024, 100 + static_cast<std::uint64_t>(i)),
                                          {.wheel_base_m = kBase_m, .resamples = 25});
    const double error = found.distance_factor.value - wheels.distance;
    sum += error;
    squares += error * error;
    told += found.distance_factor.error / kDrives;
  }
  const double spread = std::sqrt((squares - sum * sum / kDrives) / (kDrives - 1));
  // The spread of 25 is known to 14 %: 75 % is beyond five deviations of it (false alarm 1e-6), the bias of
  // the bootstrap (32 blocks) included.
  EXPECT_NEAR(told / spread, 1.0, 0.75);
}

// Motions whose truth is drawn from the filter's own model.
std::vector<MotionChain> drive_as_expected(const DifferentialDriveOptions& options, std::uint32_t count) {
  MotionChain chain;
  const RandomStream random(11, RandomPurpose::kTest, 0);
  const DifferentialDrive model(options);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Pose2 told = exp(true_motion(i));
    const auto n = random.normal4(i);
    chain.push_back({told, model.noisy_move(told).applied({}, n[0], n[1], n[2], n[3])});
  }
  return {chain};
}

TEST(OdometryCalibration, FindsTheAlphasOfTheMotionModel) {
  DifferentialDriveOptions options;
  options.alpha1 = 0.03;
  options.alpha2 = 0.02;
  options.alpha3 = 0.01;
  options.alpha4 = 0.015;
  const OdometryCalibration found = calibrate_odometry(drive_as_expected(options, 2000), {.resamples = 24});
  // What the calibration takes off as the constant part belongs to the alphas here, where the noise grows
  // with the squares of motions that are all about as long: less than 15 % in this drive.
  const auto near = [](const Estimated& alpha, double truth) {
    EXPECT_NEAR(alpha.value, truth, 6.0 * alpha.error + 0.15 * truth);
  };
  near(found.alpha1, options.alpha1);
  near(found.alpha2, options.alpha2);
  near(found.alpha3, options.alpha3);
  near(found.alpha4, options.alpha4);
  EXPECT_EQ(found.motion_options().alpha3, found.alpha3.value);
}

TEST(OdometryCalibration, TheSameSeedGivesTheSameBytes) {
  const auto chains = drive({}, 600, 5);
  const OdometryCalibration a = calibrate_odometry(chains), b = calibrate_odometry(chains);
  EXPECT_EQ(a.alpha1.error, b.alpha1.error);
  EXPECT_NE(a.alpha1.error, calibrate_odometry(chains, {.seed = 2}).alpha1.error);
}

TEST(OdometryCalibration, TooLittleIsRefused) {
  EXPECT_THROW(calibrate_odometry(drive({}, 63, 1)), InputError);
  EXPECT_THROW(calibrate_odometry({}), InputError);
  EXPECT_THROW(calibrate_odometry(drive({}, 640, 1), {.wheel_base_m = 0.0}), ConfigurationError);
}

Trajectory straight(double speed_mps, int count) {
  Trajectory path;
  for (int i = 0; i < count; ++i)
    path.push_back({Time{} + i * std::chrono::milliseconds(100), {0.1 * i * speed_mps, 0.0, 0.0}});
  return path;
}

TEST(CutMotions, CutsWhereTheOdometryHasGoneFarEnough) {
  // 0.03 m a message: a cut at every fourth.
  const auto chains = cut_motions(straight(0.3, 41), straight(0.6, 41), {.step_m = 0.1});
  ASSERT_EQ(chains.size(), 1U);
  ASSERT_EQ(chains[0].size(), 10U);
  EXPECT_NEAR(chains[0][3].told.x, 0.12, 1e-9);
  EXPECT_NEAR(chains[0][3].truth.x, 0.24, 1e-9);
}

TEST(CutMotions, NothingIsInterpolatedOverAGap) {
  Trajectory reference = straight(0.3, 41);
  reference.erase(reference.begin() + 15, reference.begin() + 30);
  const auto chains =
      cut_motions(straight(0.3, 41), reference, {.step_m = 0.1, .max_gap = std::chrono::milliseconds(500)});
  ASSERT_EQ(chains.size(), 2U);
  for (const MotionChain& chain : chains) {
    for (const MotionPair& pair : chain) EXPECT_NEAR(pair.truth.x, 0.12, 1e-9);
  }
}

TEST(CutMotions, WithoutCommonTimeThereIsNothing) {
  Trajectory later = straight(0.3, 41);
  for (StampedPose& p : later) p.stamp += std::chrono::seconds(100);
  EXPECT_TRUE(cut_motions(straight(0.3, 41), later, {}).empty());
  EXPECT_THROW(cut_motions(later, later, {.step_m = 0.0}), ConfigurationError);
}

}  // namespace
}  // namespace cairn
