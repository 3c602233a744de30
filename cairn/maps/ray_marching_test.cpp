#include "cairn/maps/ray_marching.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/core/rng.hpp"
#include "mini_maps.hpp"
#include "simd_paths.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr double kMaxRange_m = 6.0;
const Pose2 kTMapGrid{0.3, -0.2, 0.7};

// In the room and a little around it.
std::vector<Pose2> some_poses(std::size_t n, double around_m) {
  const RandomStream random(1, RandomPurpose::kTest, 0);
  std::vector<Pose2> poses;
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto u = random.uniform4(i);
    const double width = 8.0 + 2.0 * around_m, height = 5.0 + 2.0 * around_m;
    poses.push_back(kTMapGrid * Pose2{width * u[0] - around_m, height * u[1] - around_m, kTwoPi * u[2]});
  }
  return poses;
}

std::vector<double> some_bearings(int n) {
  std::vector<double> bearings;
  for (int k = 0; k < n; ++k) bearings.push_back(kTwoPi * k / n);
  return bearings;
}

std::vector<float> cast(const RayMarcher& marcher, const std::vector<Pose2>& poses,
                        const std::vector<double>& bearings) {
  std::vector<float> ranges(poses.size() * bearings.size(), -1.0f);
  marcher.cast(poses, bearings, ranges);
  return ranges;
}

// The usual way (Bresenham): cell by cell along the longer axis, from centre to centre.
double bresenham(const OccupancyGrid& grid, const Pose2& ray) {
  const GridGeometry& g = grid.geometry();
  const Point2 from = g.to_cells({ray.x, ray.y});
  const double heading = ray.theta - g.T_map_grid.theta;
  const double longer = std::max(std::abs(std::cos(heading)), std::abs(std::sin(heading)));
  const double dx = std::cos(heading) / longer, dy = std::sin(heading) / longer;
  const double x0 = std::floor(from.x) + 0.5, y0 = std::floor(from.y) + 0.5;
  for (int i = 0;; ++i) {
    const double length = std::hypot(i * dx, i * dy) * g.resolution_m;
    const int column = static_cast<int>(std::floor(x0 + i * dx)),
              row = static_cast<int>(std::floor(y0 + i * dy));
    if (length >= kMaxRange_m || !g.contains(column, row)) return kMaxRange_m;
    if (grid.state(g.index(column, row)) == CellState::kOccupied) return length;
  }
}

TEST(RayMarcher, ErrsLessThanBresenham) {
  const OccupancyGrid room = test::mini_room(kTMapGrid);
  const RayMarcher marcher(room, kMaxRange_m);
  auto poses = some_poses(400, 0.0);
  std::erase_if(poses, [&](const Pose2& p) { return room.state_at({p.x, p.y}) == CellState::kOccupied; });
  ASSERT_GT(poses.size(), 300U);
  const auto bearings = some_bearings(60);
  const auto ranges = cast(marcher, poses, bearings);
  double marched = 0.0, stepped = 0.0, wrong = 0.0;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const Pose2& pose = poses[i / bearings.size()];
    const Pose2 ray{pose.x, pose.y, pose.theta + bearings[i % bearings.size()]};
    const double exact = cast_ray(room, ray, kMaxRange_m);
    marched += std::abs(ranges[i] - exact);
    stepped += std::abs(bresenham(room, ray) - exact);
    wrong += std::abs(ranges[i] - exact) > 1e-3;
  }
  const auto n = static_cast<double>(ranges.size());
  EXPECT_LT(marched / n, 0.1 * stepped / n);
  EXPECT_LT(marched / n, 0.005);  // a tenth of a cell
  EXPECT_LT(wrong / n, 0.002);    // rays that missed a corner
}

TEST(RayMarcher, EveryPathAndEveryBatchGivesTheSameBits) {
  const RayMarcher marcher(test::mini_room(kTMapGrid), kMaxRange_m);
  const auto poses = some_poses(201, 1.0);
  const auto bearings = some_bearings(31);
  const auto expected = cast(marcher, poses, bearings);
  test::on_every_simd_path([&](SimdPath path) {
    EXPECT_EQ(cast(marcher, poses, bearings), expected) << name_of(path);
    for (std::size_t i = 0; i < poses.size(); i += 17) {
      const auto alone = cast(marcher, {poses[i]}, bearings);
      for (std::size_t k = 0; k < alone.size(); ++k) EXPECT_EQ(alone[k], expected[i * bearings.size() + k]);
    }
  });
}

// From one row of poses to rows of bearings, over more than a block of poses and with some off the map.
TEST(RayMarcher, ByBearingAreTheSameRanges) {
  const RayMarcher marcher(test::mini_room(kTMapGrid), kMaxRange_m);
  const auto poses = some_poses(201, 1.0);
  const auto bearings = some_bearings(31);
  const auto expected = cast(marcher, poses, bearings);
  std::vector<float> ranges(expected.size(), -1.0f);
  marcher.cast_by_bearing(poses, RayBearings(bearings), ranges);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (std::size_t k = 0; k < bearings.size(); ++k)
      ASSERT_EQ(ranges[k * poses.size() + i], expected[i * bearings.size() + k]) << i << ' ' << k;
  }
}

TEST(RayMarcher, AMiniatureByHand) {
  const OccupancyGrid corridor = test::draw_grid({"######",  //
                                                  "#   ?#",  //
                                                  "######"});
  const RayMarcher passing(corridor, 9.0), stopping(corridor, 9.0, RayStop::kOccupiedOrUnknown),
      shortened(corridor, 3.0);
  const std::vector<double> cross = {0.0, kPi / 2.0, kPi, -kPi / 2.0};
  const auto expect = [&](const RayMarcher& marcher, const Pose2& pose, const std::vector<double>& ranges) {
    const auto found = cast(marcher, {pose}, cross);
    for (std::size_t k = 0; k < ranges.size(); ++k) EXPECT_NEAR(found[k], ranges[k], 1e-5) << k;
  };
  expect(passing, {1.5, 1.25, 0.0}, {3.5, 0.75, 0.5, 0.25});
  expect(stopping, {1.5, 1.25, 0.0}, {2.5, 0.75, 0.5, 0.25});
  expect(shortened, {1.5, 1.25, 0.0}, {3.0, 0.75, 0.5, 0.25});
  expect(passing, {-2.0, 1.5, 0.0}, {2.0, 9.0, 9.0, 9.0});  // outside
}

// Rays from within a wall go on to the next one: along the wall there is none.
TEST(RayMarcher, LeavesTheObstacleThatItBeginsIn) {
  const OccupancyGrid room = test::draw_grid({"######",  //
                                              "#    #",  //
                                              "# ## #",  //
                                              "#    #",  //
                                              "######"});
  const RayMarcher marcher(room, 9.0);
  const auto from_table = cast(marcher, {{2.5, 2.5, 0.0}}, {0.0, kPi / 2.0, kPi, -kPi / 2.0});
  const std::vector<float> room_around = {2.5f, 1.5f, 1.5f, 1.5f};
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(from_table[k], room_around[k], 1e-5) << k;
  const auto from_wall = cast(marcher, {{0.5, 2.5, 0.0}}, {0.0, kPi / 2.0, kPi});
  EXPECT_NEAR(from_wall[0], 1.5, 1e-5);
  EXPECT_EQ(from_wall[1], 9.0f);
  EXPECT_EQ(from_wall[2], 9.0f);
}

TEST(RayMarcher, LeavesAnOpenMap) {
  const RayMarcher marcher(test::draw_grid({"  ", "  "}), 50.0);
  for (const float range : cast(marcher, {{0.5, 0.5, 0.1}, {1.9, 0.1, 2.0}}, some_bearings(16)))
    EXPECT_EQ(range, 50.0f);
}

TEST(RayMarcher, APoseThatIsNotFiniteMeetsNothing) {
  const RayMarcher marcher(test::mini_room(), kMaxRange_m);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const Pose2& pose :
       {Pose2{std::nan(""), 1, 0}, {1, kInfinity, 0}, {1, 1, std::nan("")}, {1e300, 1e300, 1}}) {
    for (const float range : cast(marcher, {pose}, some_bearings(5)))
      EXPECT_EQ(range, static_cast<float>(kMaxRange_m));
  }
}

TEST(RayMarcher, RefusesARangeThatIsNotPositive) {
  const OccupancyGrid room = test::mini_room();
  for (const double range : {0.0, -1.0, std::nan("")})
    EXPECT_THROW(RayMarcher(room, range), ConfigurationError) << range;
}

}  // namespace
}  // namespace cairn
