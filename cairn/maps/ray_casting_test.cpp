#include "cairn/maps/ray_casting.hpp"

#include "random_walls.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

std::shared_ptr<const VectorMap> shared(std::vector<Wall> walls) {
  return std::make_shared<const VectorMap>(std::move(walls));
}

std::vector<Wall> square() {
  return {{{0, 0}, {4, 0}}, {{4, 0}, {4, 4}}, {{4, 4}, {0, 4}}, {{0, 4}, {0, 0}}};
}

Point2 towards(double angle) { return {std::cos(angle), std::sin(angle)}; }

TEST(RayCasting, MeetsTheWallsOfASquare) {
  const WallGrid grid(shared(square()));
  EXPECT_DOUBLE_EQ(cast_ray(grid, {1, 1}, {1, 0}).range_m, 3.0);
  EXPECT_EQ(cast_ray(grid, {1, 1}, {1, 0}).wall, 1u);
  EXPECT_DOUBLE_EQ(cast_ray(grid, {1, 2}, {0, -1}).range_m, 2.0);
  EXPECT_DOUBLE_EQ(cast_ray(grid, {-3, 1}, {1, 0}).range_m, 3.0) << "from outside";
  EXPECT_FALSE(cast_ray(grid, {-3, 1}, {-1, 0}));
  EXPECT_FALSE(cast_ray(grid, {-3, 1}, {0, 1}));
  EXPECT_FALSE(cast_ray(grid, {1, 1}, {1, 0}, 2.9));
  EXPECT_TRUE(cast_ray(grid, {1, 1}, {1, 0}, 3.0));
}

TEST(RayCasting, EqualsBruteForceOnWallsThatCross) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const double size = seed % 2 ? 20.0 : 3000.0;
    const auto map = std::make_shared<const VectorMap>(test::random_walls(30 << seed, size, size / 8, seed));
    const WallGrid grid(map);
    const RandomStream random(seed, RandomPurpose::kTest, 1);
    int hits = 0;
    for (std::uint32_t i = 0; i < 2000; ++i) {
      const auto u = random.uniform4(i);
      Point2 origin{1.4 * size * (u[0] - 0.5), 1.4 * size * (u[1] - 0.5)};
      const double angle = i % 5 == 0 ? kPi / 4 * std::floor(8 * u[2]) : kTwoPi * u[2];
      const double max_range = i % 3 == 0 ? size * u[3] : 1e9;
      const RayHit fast = cast_ray(grid, origin, towards(angle), max_range);
      const RayHit plain = cast_ray_by_brute_force(*map, kSeenByLaser, origin, towards(angle), max_range);
      ASSERT_EQ(fast.wall, plain.wall) << "seed " << seed << " ray " << i;
      ASSERT_EQ(fast.range_m, plain.range_m) << "seed " << seed << " ray " << i;
      hits += fast ? 1 : 0;
    }
    EXPECT_GT(hits, 500);
  }
}

TEST(RayCasting, DoesNotSlipThroughACorner) {
  const WallGrid grid(shared(square()), kSeenByLaser, 0.37);
  for (int i = 1; i < 4000; ++i) {
    const Point2 origin{0.001 * i, 0.7};
    const Point2 corner{4.0 - origin.x, 4.0 - origin.y};
    const double length = std::hypot(corner.x, corner.y);
    EXPECT_NEAR(cast_ray(grid, origin, {corner.x / length, corner.y / length}).range_m, length, 1e-9);
  }
}

TEST(RayCasting, RunsAlongTheLinesOfTheGrid) {
  std::vector<Wall> walls = square();
  walls.push_back({{2, 1}, {2, 3}});
  const WallGrid grid(shared(walls), kSeenByLaser, 1.0);
  for (const double y : {1.0, 1.5, 2.0, 3.0}) EXPECT_DOUBLE_EQ(cast_ray(grid, {1, y}, {1, 0}).range_m, 1.0);
  EXPECT_DOUBLE_EQ(cast_ray(grid, {2, 0.5}, {0, 1}).range_m, 3.5) << "the wall is seen edge-on";
  EXPECT_DOUBLE_EQ(cast_ray(grid, {0, 2}, {1, 0}).range_m, 0.0) << "begins on a wall";
}

TEST(RayCasting, SeesThroughWhatTheSensorDoesNotSee) {
  const auto map = shared({{{1, -1}, {1, 1}, Material::kGlass}, {{2, -1}, {2, 1}, Material::kMesh}});
  EXPECT_DOUBLE_EQ(cast_ray(WallGrid(map), {0, 0}, {1, 0}).range_m, 2.0);
  EXPECT_DOUBLE_EQ(cast_ray(WallGrid(map, kAllMaterials), {0, 0}, {1, 0}).range_m, 1.0);
  EXPECT_FALSE(cast_ray(WallGrid(map, {Material::kMirror}), {0, 0}, {1, 0}));
}

TEST(RayCasting, WhatIsNotFiniteMeetsNothing) {
  const WallGrid grid(shared(square()));
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity}) {
    EXPECT_FALSE(cast_ray(grid, {bad, 1}, {1, 0}));
    EXPECT_FALSE(cast_ray(grid, {1, bad}, {1, 0}));
    EXPECT_FALSE(cast_ray(grid, {1, 1}, {bad, 0}));
    EXPECT_FALSE(cast_ray(grid, {1, 1}, {0.6, bad}));
  }
  EXPECT_FALSE(cast_ray(grid, {1, 1}, {1, 0}, nan));
  EXPECT_FALSE(cast_ray(grid, {1, 1}, {1, 0}, -1.0));
  EXPECT_GE(cast_ray(grid, {1e300, 1}, {-1, 0}).range_m, 0.0);
}

TEST(WallGrid, StaysSmallForMapsOfAnySize) {
  // Far apart, along a line, and a long diagonal: neither cells nor entries explode.
  for (const auto& walls : {std::vector<Wall>{{{-1e7, -1e7}, {-1e7 + 1, -1e7}}, {{1e7, 1e7}, {1e7 - 1, 1e7}}},
                            {{{0, 0}, {1e7, 0}}},
                            {{{0, 0}, {1e-6, 1e7}}},
                            {{{-1e7, -1e7}, {1e7, 1e7}}},
                            {{{0, 0}, {1e-9, 0}}}}) {
    const WallGrid grid(shared(walls), kSeenByLaser, 1e-6);
    EXPECT_LE(static_cast<double>(grid.columns()) * grid.rows(), 4.1e6);
    const Wall& wall = walls.front();
    const Point2 middle{(wall.a.x + wall.b.x) / 2, (wall.a.y + wall.b.y) / 2};
    const double dx = wall.b.x - wall.a.x, dy = wall.b.y - wall.a.y, length = std::hypot(dx, dy);
    const Point2 normal{dy / length, -dx / length};
    const RayHit hit = cast_ray(grid, {middle.x - 5 * normal.x, middle.y - 5 * normal.y}, normal);
    EXPECT_EQ(hit.wall, 0u);
    EXPECT_NEAR(hit.range_m, 5.0, 1e-7);
  }
}

}  // namespace
}  // namespace cairn
