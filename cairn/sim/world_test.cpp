#include "cairn/sim/world.hpp"

#include "cairn/core/errors.hpp"
#include "small_world.hpp"

#include <functional>

#include <gtest/gtest.h>

namespace cairn {
namespace {

using test::small_world_options;

// Key of the refusal; "accepted" if there is none.
std::string refusal(const std::function<void(WorldOptions&)>& change) {
  WorldOptions options = small_world_options();
  change(options);
  try {
    make_world(options);
  } catch (const ConfigurationError& error) {
    return error.where();
  }
  return "accepted";
}

TEST(World, IsBuiltFromItsOptions) {
  WorldOptions options = small_world_options();
  options.furniture.push_back({"desk", "4,3", 2.0, 1.0, 0.0, "opaque", true, ""});
  options.furniture.push_back({"cart", "6,1", 0.5, 0.5, 0.0, "opaque", false, ""});
  options.furniture.push_back({"chair", "2,5", 0.5, 0.5, 0.0, "opaque", true, "4,5"});
  const World world = make_world(options);
  EXPECT_EQ(world.solid->walls().size(), 16U);
  EXPECT_EQ(world.map.state_at({3.0, 3.0}), CellState::kOccupied) << "the desk's side";
  EXPECT_EQ(world.map.state_at({5.75, 1.0}), CellState::kFree) << "the cart is not on the map";
  EXPECT_EQ(world.map.state_at({1.75, 5.0}), CellState::kFree) << "where the chair is";
  EXPECT_EQ(world.map.state_at({3.75, 5.0}), CellState::kOccupied) << "where the map shows it";
  EXPECT_FALSE(world.planner.is_free({6.0, 1.0}));
  EXPECT_TRUE(world.planner.is_free({4.0, 5.0}));
}

TEST(World, RefusesWhatDoesNotFitAndNamesTheKey) {
  EXPECT_EQ(refusal([](WorldOptions&) {}), "accepted");
  EXPECT_EQ(refusal([](WorldOptions& o) { o.walls[0].points = "0,0 8,0"; }), "walls.outline.points");
  EXPECT_EQ(refusal([](WorldOptions& o) { o.walls[0].closed = false; }), "walls") << "open outline";
  EXPECT_EQ(refusal([](WorldOptions& o) { o.walls[0].points = "0,0 8,0 8,0 0,6"; }), "walls.outline.points");
  EXPECT_EQ(refusal([](WorldOptions& o) { o.walls[0].points = "0,0 8;0 8,6 0,6"; }), "walls.outline.points");
  EXPECT_EQ(refusal([](WorldOptions& o) { o.walls.clear(); }), "walls");
  EXPECT_EQ(refusal([](WorldOptions& o) { o.lasers.clear(); }), "lasers");
  EXPECT_EQ(refusal([](WorldOptions& o) { o.lasers[0].mount = "2,0,0"; }), "lasers.front.mount");
  EXPECT_EQ(refusal([](WorldOptions& o) { o.lasers[0].mount = "0,0"; }), "lasers.front.mount");
  EXPECT_EQ(refusal([](WorldOptions& o) { o.lasers[0].range_max_m = 0.01; }), "lasers.front.range_max_m");
  EXPECT_EQ(refusal([](WorldOptions& o) {
              o.lasers[0].timing.rate_hz = 1000.0;
              o.lasers[0].beams = 100'000;
            }),
            "lasers.front.rate_hz");
  EXPECT_EQ(refusal([](WorldOptions& o) { o.robot.start = "0.1,3,0"; }), "robot.start");
  EXPECT_EQ(refusal([](WorldOptions& o) { o.robot.start = "20,3,0"; }), "robot.start");
  EXPECT_EQ(refusal([](WorldOptions& o) { o.people.crowd = 4, o.people.crowd_distance_m = 0.5; }),
            "people.crowd_distance_m");
  EXPECT_EQ(refusal([](WorldOptions& o) { o.doors.push_back({"d", "1,1", "1,1"}); }), "doors.d.to");
  EXPECT_EQ(refusal([](WorldOptions& o) {
              o.furniture.push_back({"box", "x", 1.0, 1.0, 0.0, "opaque", true, ""});
            }),
            "furniture.box.center");
}

TEST(World, ADoorOpensAndCloses) {
  const WorldDoor door{{}, 20.0, 10.0, 5.0};
  EXPECT_FALSE(door.is_closed(0.0));
  EXPECT_FALSE(door.is_closed(14.9));
  EXPECT_TRUE(door.is_closed(15.1));
  EXPECT_TRUE(door.is_closed(24.9));
  EXPECT_FALSE(door.is_closed(25.1));
}

TEST(World, AllBuiltInWorldsCanBeBuilt) {
  for (const char* name : {"office", "cross", "hall", "corridor", "warehouse"}) {
    EXPECT_NO_THROW(make_world(built_in_world(name, 3))) << name;
  }
  EXPECT_THROW(built_in_world("moon", 1), ConfigurationError);
}

// The laws that give the cross and the corridor their use.
TEST(World, TheCrossIsTheSameAfterAQuarterTurn) {
  const World world = make_world(built_in_world("cross", 1));
  for (double x = -8.0; x <= 8.0; x += 0.25) {
    for (double y = -8.0; y <= 8.0; y += 0.25) {
      EXPECT_EQ(world.planner.is_free({x + 0.05, y + 0.05}), world.planner.is_free({-y - 0.05, x + 0.05}));
    }
  }
}

TEST(World, TheCorridorRepeatsEveryFiveMetres) {
  const OccupancyGrid map = make_world(built_in_world("corridor", 1)).map;
  for (double x = 6.0; x < 90.0; x += 0.05) {
    for (double y = -2.0; y < 2.0; y += 0.05) {
      ASSERT_EQ(map.state_at({x + 0.01, y + 0.01}), map.state_at({x + 5.01, y + 0.01})) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace cairn
