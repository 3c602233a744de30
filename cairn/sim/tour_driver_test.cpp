#include "cairn/sim/tour_driver.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

const std::vector<Point2> kZigzag{{3.0, 0.0}, {3.0, 2.0}, {0.0, 2.0}, {0.0, 0.0}};

double nearest(const Trajectory& path, const Point2& p) {
  double best = 1e9;
  for (const auto& [stamp, pose] : path) best = std::min(best, std::hypot(pose.x - p.x, pose.y - p.y));
  return best;
}

TEST(DriveTour, ReachesEveryWaypointAndStops) {
  const Trajectory path = drive_tour({0.0, 0.0, 0.0}, kZigzag, {});
  for (const Point2& p : kZigzag) EXPECT_LT(nearest(path, p), 0.1);
  EXPECT_LT(std::hypot(path.back().pose.x, path.back().pose.y), 0.1);
  EXPECT_NEAR(path_length(path), 10.0, 0.6);
}

TEST(DriveTour, StaysNearTheLinesBetweenWaypoints) {
  for (const auto& [stamp, pose] : drive_tour({0.0, 0.0, 0.0}, kZigzag, {})) {
    double aside = 1e9;
    Point2 from = kZigzag.back();
    for (const Point2& to : kZigzag) {
      const double length = std::hypot(to.x - from.x, to.y - from.y);
      const double s = std::clamp(
          ((pose.x - from.x) * (to.x - from.x) + (pose.y - from.y) * (to.y - from.y)) / (length * length),
          0.0, 1.0);
      aside = std::min(aside,
                       std::hypot(pose.x - std::lerp(from.x, to.x, s), pose.y - std::lerp(from.y, to.y, s)));
      from = to;
    }
    EXPECT_LT(aside, 0.15);
  }
}

TEST(DriveTour, KeepsItsLimitsOfSpeedAndAcceleration) {
  const DriveLimits limits;
  const Trajectory path = drive_tour({0.0, 0.0, 2.0}, kZigzag, limits);
  const double dt = to_seconds(limits.step);
  Twist2 before;
  for (std::size_t i = 1; i < path.size(); ++i) {
    ASSERT_EQ(path[i].stamp - path[i - 1].stamp, limits.step);
    const Twist2 moved = log(between(path[i - 1].pose, path[i].pose));
    ASSERT_NEAR(moved.y, 0.0, 1e-9) << "a differential drive does not slip sideways";
    ASSERT_LE(std::abs(moved.x) / dt, limits.speed_mps + 1e-6);
    ASSERT_LE(std::abs(moved.theta) / dt, limits.turn_rate_radps + 1e-6);
    ASSERT_LE(std::abs(moved.x - before.x) / (dt * dt), limits.acceleration_mps2 + 1e-3);
    ASSERT_LE(std::abs(moved.theta - before.theta) / (dt * dt), limits.turn_acceleration_radps2 + 1e-3);
    before = moved;
  }
}

TEST(DriveTour, DrivesAsLongAsAsked) {
  const Trajectory once = drive_tour({}, kZigzag, {});
  const Trajectory longer = drive_tour({}, kZigzag, {}, duration_from_seconds(200.0));
  EXPECT_LT(once.back().stamp, time_from_seconds(100.0));
  EXPECT_EQ(longer.back().stamp, time_from_seconds(200.0));
  EXPECT_TRUE(std::equal(once.begin(), once.end(), longer.begin()));
  EXPECT_EQ(drive_tour({}, kZigzag, {}, duration_from_seconds(3.0)).back().stamp, time_from_seconds(3.0));
}

TEST(DriveTour, RefusesWhatCannotBeDriven) {
  EXPECT_THROW(drive_tour({}, {}, {}), ConfigurationError);
  EXPECT_THROW(drive_tour({}, kZigzag, {.speed_mps = 0.0}), ConfigurationError);
  EXPECT_THROW(drive_tour({}, kZigzag, {.step = Duration::zero()}), ConfigurationError);
  EXPECT_THROW(drive_tour({}, {{1e6, 0.0}}, {.step = std::chrono::seconds(1)}), ConfigurationError);
}

}  // namespace
}  // namespace cairn
