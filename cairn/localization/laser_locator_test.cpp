#include "cairn/localization/laser_locator.hpp"

#include "mini_maps.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr Pose2 kTruth{2.03, 3.02, 0.5};
constexpr double kRing_m = 0.7;
constexpr Point2 kCloset{6.75, 4.0};

// The room with a closet in its solid corner, as round as a ring of people.
std::shared_ptr<const OccupancyGrid> room_with_closet() {
  const OccupancyGrid room = test::mini_room();
  std::vector<OccupancyGrid::Cell> cells(room.cells().begin(), room.cells().end());
  const GridGeometry& grid = room.geometry();
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      const double x = (column + 0.5) * grid.resolution_m, y = (row + 0.5) * grid.resolution_m;
      if (std::hypot(x - kCloset.x, y - kCloset.y) < kRing_m)
        cells[static_cast<std::size_t>(row * grid.width + column)] = 0;
    }
  }
  return std::make_shared<const OccupancyGrid>(grid, std::move(cells));
}

// Four of five beams end at people around the robot.
Glimpse in_a_crowd(const OccupancyGrid& map) {
  LaserScan scan = test::scan_of(map, kTruth, 360);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (i % 20 >= 4) scan.ranges_m[i] = std::min(scan.ranges_m[i], static_cast<float>(kRing_m));
  }
  return {std::make_shared<const LaserScan>(std::move(scan)), {}};
}

std::vector<LocatedPose> found_with(double crowd_m, const std::vector<Glimpse>& glimpses) {
  LaserLocator::Options options;
  options.likelihood.sigma_hit_m = 0.1;
  options.crowd_m = crowd_m;
  return LaserLocator(room_with_closet(), {}, {}, options).search(glimpses);
}

bool is_among(const std::vector<LocatedPose>& places, const Pose2& pose) {
  return std::any_of(places.begin(), places.end(), [&](const LocatedPose& place) {
    return distance(place.T_map_base, pose) < 0.1 && std::abs(place.T_map_base.theta - pose.theta) < 0.05;
  });
}

TEST(LaserLocator, SeesPastPeopleAroundTheRobot) {
  const std::vector<Glimpse> glimpses{in_a_crowd(*room_with_closet())};
  const auto all_beams = found_with(0.0, glimpses);
  ASSERT_FALSE(all_beams.empty());
  EXPECT_FALSE(is_among(all_beams, kTruth)) << "the closet explains more beams";
  EXPECT_TRUE(is_among(found_with(1.0, glimpses), kTruth));
}

TEST(LaserLocator, WhereNothingIsNearOneSearchIsEnough) {
  const auto map = room_with_closet();
  const std::vector<Glimpse> glimpses{
      {std::make_shared<const LaserScan>(test::scan_of(*map, kTruth, 360)), {}}};
  const auto found = found_with(1.0, glimpses);
  EXPECT_TRUE(is_among(found, kTruth));
  EXPECT_EQ(found.size(), found_with(0.0, glimpses).size());
}

TEST(LaserLocator, FindsNothingWithoutABeam) {
  EXPECT_TRUE(found_with(1.0, {}).empty());
  LaserScan empty;
  empty.angle_increment_rad = 0.1;
  empty.ranges_m.assign(10, 0.0f);
  EXPECT_TRUE(found_with(1.0, {{std::make_shared<const LaserScan>(empty), {}}}).empty());
}

}  // namespace
}  // namespace cairn
