#include "cairn/sim/office_world.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

bool same_walls(const OfficeWorld& a, const OfficeWorld& b) {
  return std::equal(a.building.walls.begin(), a.building.walls.end(), b.building.walls.begin(),
                    b.building.walls.end(),
                    [](const Segment& s, const Segment& t) { return s.a == t.a && s.b == t.b; });
}

// Calls check(point) every few centimetres of the tour.
template <typename Check>
void along_tour(const OfficeWorld& world, const Check& check) {
  Point2 from{world.start.x, world.start.y};
  for (const Point2& to : world.tour) {
    for (int i = 0; i <= 100; ++i)
      check(Point2{std::lerp(from.x, to.x, i / 100.0), std::lerp(from.y, to.y, i / 100.0)});
    from = to;
  }
}

TEST(MakeOffice, IsAFunctionOfItsSeed) {
  const OfficeWorld a = make_office({}, 1);
  EXPECT_TRUE(same_walls(a, make_office({}, 1)));
  EXPECT_FALSE(same_walls(a, make_office({}, 2)));
}

TEST(MakeOffice, HasItsRoomsFurnitureAndPeople) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const OfficeWorld world = make_office({}, seed);
    EXPECT_EQ(world.rooms.size(), 10U);
    EXPECT_GE(world.people.size(), 4U);
    const OfficeWorld empty = make_office({.furniture_per_room = 0, .people = 0}, seed);
    EXPECT_GE(world.building.walls.size(), empty.building.walls.size() + 4 * 20)
        << "20 of 30 pieces find a place";
    EXPECT_TRUE(empty.people.empty());
  }
}

TEST(MakeOffice, TheTourPassesThroughEveryRoomAndKeepsClear) {
  const OfficeOptions options;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const OfficeWorld world = make_office(options, seed);
    // Doors leave less than the clearance; nothing else may.
    const double door = 0.5 * options.door_width_m - 1e-9;
    along_tour(world, [&](const Point2& p) {
      for (const Segment& wall : world.building.walls) ASSERT_GE(distance(p, wall), door);
      for (const Cylinder& person : world.people) {
        ASSERT_GE(std::hypot(p.x - person.center.x, p.y - person.center.y),
                  person.radius_m + options.clearance_m);
      }
    });
    for (const Rectangle& room : world.rooms) {
      EXPECT_NE(std::find(world.tour.begin(), world.tour.end(), room.center()), world.tour.end());
    }
    EXPECT_EQ(world.tour.back(), (Point2{world.start.x, world.start.y}));
  }
}

TEST(MakeOffice, IsClosedAndAllOfTheTourIsFreeInItsMap) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const OfficeWorld world = make_office({}, seed);
    const OccupancyGrid map = rasterize(world.building, {world.start.x, world.start.y}, 0.05);
    along_tour(world, [&](const Point2& p) { ASSERT_EQ(map.state_at(p), CellState::kFree); });
  }
}

TEST(MakeOffice, RefusesSizesThatDoNotFit) {
  EXPECT_THROW(make_office({.rooms_per_side = 0}, 1), ConfigurationError);
  EXPECT_THROW(make_office({.door_width_m = 3.5}, 1), ConfigurationError);
  EXPECT_THROW(make_office({.min_room_width_m = 9.0}, 1), ConfigurationError);
  EXPECT_THROW(make_office({.corridor_width_m = std::nan("")}, 1), ConfigurationError);
  EXPECT_THROW(make_office({.furniture_per_room = -1}, 1), ConfigurationError);
}

}  // namespace
}  // namespace cairn
