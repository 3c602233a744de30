#include "cairn/maps/grid_ray_caster.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/rng.hpp"
#include "mini_maps.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace cairn {
namespace {

const OccupancyGrid kCorridor = test::draw_grid({"######",  //
                                                 "#   ?#",  //
                                                 "######"});

TEST(CastRay, AMiniatureByHand) {
  EXPECT_DOUBLE_EQ(cast_ray(kCorridor, {1.5, 1.5, 0.0}, 9.0), 3.5);
  EXPECT_DOUBLE_EQ(cast_ray(kCorridor, {1.5, 1.5, kPi}, 9.0), 0.5);
  EXPECT_DOUBLE_EQ(cast_ray(kCorridor, {1.5, 1.25, kPi / 2.0}, 9.0), 0.75);
  EXPECT_DOUBLE_EQ(cast_ray(kCorridor, {1.5, 1.25, -kPi / 2.0}, 9.0), 0.25);
  EXPECT_NEAR(cast_ray(kCorridor, {1.5, 1.25, kPi / 4.0}, 9.0), 0.75 * std::sqrt(2.0), 1e-12);
  EXPECT_EQ(cast_ray(kCorridor, {0.5, 0.5, 1.0}, 9.0), 0.0);  // within a wall
  EXPECT_EQ(cast_ray(kCorridor, {1.5, 1.5, 0.0}, 3.0), 3.0);  // cut
}

TEST(CastRay, UnknownCellsStopWhereAsked) {
  EXPECT_DOUBLE_EQ(cast_ray(kCorridor, {1.5, 1.5, 0.0}, 9.0, RayStop::kOccupiedOrUnknown), 2.5);
}

TEST(CastRay, EntersTheGridFromOutsideAndLeavesIt) {
  EXPECT_DOUBLE_EQ(cast_ray(kCorridor, {-2.0, 1.5, 0.0}, 9.0), 2.0);
  EXPECT_DOUBLE_EQ(cast_ray(kCorridor, {3.0, 7.0, -kPi / 2.0}, 9.0), 4.0);
  EXPECT_EQ(cast_ray(kCorridor, {-2.0, 1.5, kPi}, 9.0), 9.0);
  EXPECT_EQ(cast_ray(kCorridor, {-2.0, 7.0, 0.0}, 9.0), 9.0);
  const OccupancyGrid open = test::draw_grid({"  ", "  "});
  EXPECT_EQ(cast_ray(open, {0.5, 0.5, 0.3}, 9.0), 9.0);
}

TEST(CastRay, AnythingThatIsNotFiniteMeetsNothing) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::nan(""), kInfinity, -kInfinity, 1e300}) {
    EXPECT_EQ(cast_ray(kCorridor, {bad, 1.5, 0.0}, 9.0), 9.0);
    EXPECT_EQ(cast_ray(kCorridor, {1.5, bad, 0.0}, 9.0), 9.0);
    EXPECT_LE(cast_ray(kCorridor, {1.5, 1.5, bad}, 9.0), 9.0);
  }
}

// Against small steps along the ray, in a grid that is turned in the map.
TEST(CastRay, EqualsSmallSteps) {
  const OccupancyGrid room = test::mini_room({0.3, -0.2, 0.7});
  const RandomStream random(1, RandomPurpose::kTest, 0);
  constexpr double kStep = 1e-4;
  for (std::uint32_t i = 0; i < 60; ++i) {
    const auto u = random.uniform4(i);
    const Pose2 ray = room.geometry().T_map_grid * Pose2{8.0 * u[0], 5.0 * u[1], kTwoPi * u[2]};
    double steps = 0.0;
    while (steps < 6.0 && room.state_at(ray * Point2{steps, 0.0}) != CellState::kOccupied) steps += kStep;
    // A corner may be cut by less than a step.
    EXPECT_LE(cast_ray(room, ray, 6.0), steps + 1e-9);
    const double exact = cast_ray(room, ray, 6.0);
    if (exact + 1e-6 < std::min(steps, 6.0) - kStep) {
      const Point2 before = ray * Point2{exact + 1e-9, 0.0};
      EXPECT_EQ(room.state_at(before), CellState::kOccupied) << i;
    }
  }
}

}  // namespace
}  // namespace cairn
