#include "cairn/sim/laser_scanner.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/sim/ray_caster.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

FloorPlan long_room() {
  FloorPlan plan;
  add_outline({{0.0, 0.0}, {30.0, 4.0}}, plan.walls);
  return plan;
}

constexpr Pose2 kPose{2.0, 2.0, 0.3};
constexpr LaserScannerOptions kPerfect{.sigma_range_m = 0.0, .dropout_probability = 0.0};

TEST(LaserScanner, WithoutNoiseTellsTheExactRanges) {
  const FloorPlan room = long_room();
  const LaserScan scan = simulate_scan(room, kPose, time_from_seconds(5.0), kPerfect, 1, 0);
  ASSERT_EQ(scan.ranges_m.size(), 361U);
  EXPECT_EQ(scan.stamp, time_from_seconds(5.0));
  EXPECT_NEAR(scan.angle_min_rad + 360 * scan.angle_increment_rad, 0.75 * kPi, 1e-9);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double angle = scan.angle_min_rad + static_cast<double>(i) * scan.angle_increment_rad;
    const double truth = cast_ray(room, {kPose.x, kPose.y, kPose.theta + angle}).value();
    EXPECT_NEAR(scan.ranges_m[i], std::min(truth, 20.0), 1e-5);
    EXPECT_EQ(scan.is_valid_range(scan.ranges_m[i]), truth < 20.0);
  }
}

TEST(LaserScanner, NoiseAndDropoutsAreAsAsked) {
  const LaserScannerOptions noisy{.sigma_range_m = 0.02, .dropout_probability = 0.1};
  const FloorPlan room = long_room();
  const LaserScan truth = simulate_scan(room, kPose, {}, kPerfect, 1, 0);
  double sum = 0.0;
  double squares = 0.0;
  int n = 0;
  int beams = 0;
  for (std::uint64_t index = 0; index < 50; ++index) {
    const LaserScan scan = simulate_scan(room, kPose, {}, noisy, 1, index);
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      if (truth.ranges_m[i] > 19.0F) continue;
      ++beams;
      if (!scan.is_valid_range(scan.ranges_m[i])) continue;
      const double error = scan.ranges_m[i] - truth.ranges_m[i];
      sum += error;
      squares += error * error;
      ++n;
    }
  }
  // About 17,000 beams: five standard errors each.
  EXPECT_NEAR(sum / n, 0.0, 5 * 0.02 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), 0.02, 5 * 0.02 / std::sqrt(2.0 * n));
  EXPECT_NEAR(1.0 - static_cast<double>(n) / beams, 0.1, 5 * std::sqrt(0.09 / beams));
}

TEST(LaserScanner, IsAFunctionOfSeedAndIndex) {
  const FloorPlan room = long_room();
  const auto ranges = [&](std::uint64_t seed, std::uint64_t index) {
    return simulate_scan(room, kPose, {}, {}, seed, index).ranges_m;
  };
  EXPECT_EQ(ranges(1, 7), ranges(1, 7));
  EXPECT_NE(ranges(1, 7), ranges(1, 8));
  EXPECT_NE(ranges(1, 7), ranges(2, 7));
}

TEST(LaserScanner, RefusesOptionsOutOfRange) {
  EXPECT_THROW(LaserScannerOptions{.beams = 1}.validate(), ConfigurationError);
  EXPECT_THROW(LaserScannerOptions{.range_max_m = 0.0}.validate(), ConfigurationError);
  EXPECT_THROW(LaserScannerOptions{.dropout_probability = 1.5}.validate(), ConfigurationError);
  EXPECT_THROW(LaserScannerOptions{.sigma_range_m = std::nan("")}.validate(), ConfigurationError);
}

}  // namespace
}  // namespace cairn
