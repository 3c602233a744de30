#include "cairn/sim/world_scene.hpp"

#include "cairn/sim/world_laser.hpp"
#include "simulated_scene.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(WorldScene, TellsHowHighThingsAre) {
  const test::SimulatedScene scene([](WorldOptions& o) {
    o.furniture.push_back({"desk", "4,1", 2.0, 1.0, 0.0, "opaque", true, "", 0.0, 0.75});
    o.ceiling.height_m = 3.0;
  });
  const auto desk = scene.scene().nearest({1.0, 1.0}, {1.0, 0.0}, 20.0);
  ASSERT_TRUE(desk.has_value());
  EXPECT_NEAR(desk->range_m, 2.0, 1e-9);
  EXPECT_EQ(desk->span.top_m, 0.75);
  EXPECT_EQ(desk->span.box, 0);
  const auto wall = scene.scene().nearest({1.0, 1.0}, {0.0, 1.0}, 20.0);
  EXPECT_EQ(wall->span.top_m, 3.0) << "walls go up to the ceiling";
  EXPECT_EQ(wall->span.box, HeightSpan::kNoBox);
}

TEST(WorldScene, VisitsAllThatStandsBetween) {
  const test::SimulatedScene scene([](WorldOptions& o) {
    o.walls.push_back({"a", "3,0.5 3,1.5", false, "glass", true});
    o.walls.push_back({"b", "5,0.5 5,1.5", false, "opaque", true});
    o.doors.push_back({"d", "6,0.5", "6,1.5", 5.0, 5.0, 7.0, false});
  });
  std::vector<double> ranges;
  const auto visit = [&](const WorldScene::Surface& surface) {
    ranges.push_back(surface.range_m);
    return true;
  };
  scene.scene().visit_between({1.0, 1.0}, {7.0, 1.0}, visit);
  ASSERT_EQ(ranges.size(), 3U);
  EXPECT_NEAR(ranges[0], 2.0, 1e-5);
  EXPECT_NEAR(ranges[1], 4.0, 1e-5);
  EXPECT_NEAR(ranges[2], 5.0, 1e-5);
  ranges.clear();
  scene.scene().visit_between({1.0, 1.0}, {8.0, 1.0}, visit);
  EXPECT_EQ(ranges.size(), 3U) << "what hangs on the eastern wall is not behind it";
}

TEST(WorldScene, ALaserLooksOverWhatIsLowAndUnderWhatHangs) {
  const auto range = [](double bottom_m, double top_m, double laser_m) {
    const test::SimulatedScene scene([&](WorldOptions& o) {
      o.furniture.push_back({"box", "4,1", 2.0, 1.0, 0.0, "opaque", true, "", bottom_m, top_m});
    });
    const SimulatedDrive& d = scene.drive();
    return BeamCaster(d.world, d.walls, d.people, 0.0, laser_m).cast({1.0, 1.0}, 0.0, 20.0, 0.9)->range_m;
  };
  EXPECT_NEAR(range(0.0, 0.75, 0.3), 2.0, 1e-9);
  EXPECT_NEAR(range(0.0, 0.75, 0.9), 7.0, 1e-4) << "over the desk";
  EXPECT_NEAR(range(0.5, 0.75, 0.3), 7.0, 1e-4) << "under the board";
  EXPECT_NEAR(range(0.5, 0.75, 0.6), 2.0, 1e-9);
}

}  // namespace
}  // namespace cairn
