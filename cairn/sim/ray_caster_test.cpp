#include "cairn/sim/ray_caster.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/rng.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

FloorPlan square_room() {
  FloorPlan plan;
  add_outline({{0.0, 0.0}, {4.0, 4.0}}, plan.walls);
  return plan;
}

TEST(CastRay, MeetsTheWallsOfASquare) {
  const FloorPlan room = square_room();
  EXPECT_NEAR(cast_ray(room, {1.0, 1.0, 0.0}).value(), 3.0, 1e-12);
  EXPECT_NEAR(cast_ray(room, {1.0, 1.0, kPi}).value(), 1.0, 1e-12);
  EXPECT_NEAR(cast_ray(room, {1.0, 2.0, kPi / 2}).value(), 2.0, 1e-12);
  EXPECT_NEAR(cast_ray(room, {1.0, 1.0, -kPi / 4}).value(), std::sqrt(2.0), 1e-12);
}

TEST(CastRay, DoesNotSlipThroughACorner) {
  const FloorPlan room = square_room();
  for (int i = 1; i < 1000; ++i) {
    const Point2 p{0.004 * i, 0.7};
    const double to_corner = std::atan2(4.0 - p.y, 4.0 - p.x);
    EXPECT_NEAR(cast_ray(room, {p.x, p.y, to_corner}).value(), std::hypot(4.0 - p.x, 4.0 - p.y), 1e-6);
  }
}

TEST(CastRay, MeetsACylinder) {
  FloorPlan plan = square_room();
  plan.cylinders.push_back({{2.0, 2.0}, 0.5});
  EXPECT_NEAR(cast_ray(plan, {0.5, 2.0, 0.0}).value(), 1.0, 1e-12);
  EXPECT_NEAR(cast_ray(plan, {0.5, 2.4, 0.0}).value(), 1.5 - 0.3, 1e-12);
  EXPECT_NEAR(cast_ray(plan, {0.5, 2.6, 0.0}).value(), 3.5, 1e-12);
  EXPECT_NEAR(cast_ray(plan, {3.0, 2.0, 0.0}).value(), 1.0, 1e-12) << "the cylinder is behind";
  EXPECT_EQ(cast_ray(plan, {2.1, 2.1, 0.0}).value(), 0.0);
}

TEST(CastRay, MayMeetNothing) {
  EXPECT_FALSE(cast_ray({}, {0.0, 0.0, 0.0}).has_value());
  EXPECT_FALSE(cast_ray(square_room(), {5.0, 2.0, 0.0}).has_value());
  const FloorPlan edge_on{{{{1.0, 0.0}, {2.0, 0.0}}}, {}};
  EXPECT_FALSE(cast_ray(edge_on, {0.0, 0.0, 0.0}).has_value());
}

// Sphere tracing, an independent way: steps of the distance to the nearest thing never overshoot.
double march(const FloorPlan& plan, const Pose2& ray) {
  double range = 0.0;
  for (int step = 0; step < 100'000; ++step) {
    const Point2 p{ray.x + range * std::cos(ray.theta), ray.y + range * std::sin(ray.theta)};
    double nearest = 1e9;
    for (const Segment& wall : plan.walls) nearest = std::min(nearest, distance(p, wall));
    for (const Cylinder& c : plan.cylinders) {
      nearest = std::min(nearest, std::hypot(p.x - c.center.x, p.y - c.center.y) - c.radius_m);
    }
    if (nearest < 1e-7) break;
    range += nearest;
  }
  return range;
}

TEST(CastRay, AgreesWithMarching) {
  FloorPlan plan = square_room();
  add_outline({{2.5, 0.5}, {3.5, 0.8}}, plan.walls);
  plan.walls.push_back({{0.3, 3.5}, {1.7, 2.9}});
  plan.cylinders.push_back({{2.0, 2.0}, 0.4});
  const RandomStream random(7, RandomPurpose::kTest, 0);
  for (std::uint32_t i = 0; i < 2000; ++i) {
    const auto u = random.uniform4(i);
    const Pose2 ray{1.0 + 0.5 * u[0], 1.0 + 0.5 * u[1], kTwoPi * u[2] - kPi};
    // A ray that grazes a wall is stopped by marching a little early.
    EXPECT_NEAR(cast_ray(plan, ray).value(), march(plan, ray), 1e-4);
  }
}

}  // namespace
}  // namespace cairn
