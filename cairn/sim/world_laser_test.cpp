#include "cairn/sim/world_laser.hpp"

#include "small_world.hpp"

#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// The scene around a laser that stands at (1, 1), looks along x, and has no noise.
class Scene {
 public:
  explicit Scene(const std::function<void(WorldOptions&)>& change) {
    WorldOptions options = test::small_world_options();
    options.lasers[0].sigma_range_m = 0.0;
    options.lasers[0].no_return_share = 0.0;
    change(options);
    world_.emplace(make_world(options));
    walls_.emplace(world_->solid, kAllMaterials);
    truth_ = {{Time{}, world_->start}, {time_from_seconds(10.0), world_->start * Pose2{2.0, 0.0, 0.0}}};
    people_.emplace(*world_, truth_, 1);
  }

  std::optional<double> range(double angle_rad, double mesh_draw = 0.9) const {
    const auto met = BeamCaster(*world_, *walls_, *people_, 0.0).cast({1.0, 1.0}, angle_rad, 20.0, mesh_draw);
    return met ? std::optional(met->range_m) : std::nullopt;
  }
  LaserScan scan(double time_s = 0.0, std::uint64_t index = 0) const {
    return simulate_world_scan(*world_, *walls_, *people_, truth_, world_->options.lasers[0],
                               time_from_seconds(time_s), 0, index, 1);
  }
  static Scene with_wall(const char* points, const char* material) {
    return Scene([=](WorldOptions& o) { o.walls.push_back({"w", points, false, material, true}); });
  }

 private:
  std::optional<World> world_;
  std::optional<WallGrid> walls_;
  std::optional<People> people_;
  Trajectory truth_;
};

TEST(WorldLaser, SeesTheNearestWall) {
  const Scene scene([](WorldOptions&) {});
  EXPECT_NEAR(*scene.range(0.0), 7.0, 1e-9);
  EXPECT_NEAR(*scene.range(0.5 * std::numbers::pi), 5.0, 1e-9);
  EXPECT_NEAR(*scene.range(std::numbers::pi), 1.0, 1e-9);
}

TEST(WorldLaser, GlassReturnsNearNormalBeamsOnly) {
  const Scene scene = Scene::with_wall("5,0.5 5,5.5", "glass");
  EXPECT_NEAR(*scene.range(0.0), 4.0, 1e-9);
  EXPECT_NEAR(*scene.range(0.1), 4.0 / std::cos(0.1), 1e-9);
  EXPECT_NEAR(*scene.range(0.3), 7.0 / std::cos(0.3), 1e-4) << "through the glass to the wall";
}

TEST(WorldLaser, MeshReturnsSome) {
  const Scene scene = Scene::with_wall("5,0.5 5,5.5", "mesh");
  EXPECT_NEAR(*scene.range(0.0, 0.1), 4.0, 1e-9);
  EXPECT_NEAR(*scene.range(0.0, 0.9), 7.0, 1e-4);
}

// A beam at 45 degrees onto a mirror along x at y = 5 turns down and meets the floor's eastern wall.
TEST(WorldLaser, AMirrorShowsAnotherPlace) {
  const Scene scene = Scene::with_wall("0.5,5 7.5,5", "mirror");
  EXPECT_NEAR(*scene.range(0.25 * std::numbers::pi), 7.0 * std::sqrt(2.0), 1e-4);
  EXPECT_NEAR(*scene.range(0.5 * std::numbers::pi), 4.0 + 5.0, 1e-4) << "there, and back to the wall behind";
}

TEST(WorldLaser, GrazingBeamsDoNotReturn) {
  const Scene scene([](WorldOptions& o) {
    o.lasers[0].grazing_rad = 0.3;
    o.lasers[0].field_of_view_rad = 1.6;
    o.lasers[0].beams = 3;
  });
  const LaserScan scan = scene.scan();
  EXPECT_NEAR(scan.ranges_m[1], 7.0, 1e-6);
  EXPECT_FALSE(scan.is_valid_range(scan.ranges_m[0])) << "0.8 rad onto the southern wall";
}

TEST(WorldLaser, DoorsAndPeopleAreSeen) {
  const Scene door([](WorldOptions& o) { o.doors.push_back({"d", "4,0.5", "4,1.5", 5.0, 5.0, 7.0, false}); });
  EXPECT_NEAR(*door.range(0.0), 3.0, 1e-9) << "closed at the start";
  const Scene crowd([](WorldOptions& o) {
    o.people.crowd = 4;
    o.people.crowd_distance_m = 0.9;
  });
  EXPECT_NEAR(*crowd.range(0.0), 0.9 - 0.22, 1e-6);
}

TEST(WorldLaser, SweepsFromAMovingRobot) {
  const Scene scene([](WorldOptions& o) {
    o.lasers[0].sweep_s = 1.0;
    o.lasers[0].beams = 3;
    o.lasers[0].field_of_view_rad = 0.002;
  });
  const LaserScan scan = scene.scan(0.0);
  EXPECT_NEAR(scan.ranges_m[0], 7.0, 1e-4);
  EXPECT_NEAR(scan.ranges_m[2], 6.8, 1e-4) << "0.2 m farther on after a second";
}

// 91 beams of 200 scans: shares within 6 standard deviations (alpha 1e-8 each).
TEST(WorldLaser, ErrorsAreAsFrequentAsAsked) {
  const Scene scene([](WorldOptions& o) {
    o.lasers[0].no_return_share = 0.1;
    o.lasers[0].short_share = 0.2;
    o.lasers[0].sigma_range_m = 0.01;
  });
  const Scene clean([](WorldOptions&) {});
  const LaserScan truth = clean.scan();
  int none = 0, early = 0, all = 0;
  for (std::uint64_t index = 0; index < 200; ++index) {
    const LaserScan scan = scene.scan(0.0, index);
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i, ++all) {
      none += scan.is_valid_range(scan.ranges_m[i]) ? 0 : 1;
      early += scan.ranges_m[i] < truth.ranges_m[i] - 0.07f ? 1 : 0;
    }
  }
  const double n = all;
  EXPECT_NEAR(none / n, 0.1, 6.0 * std::sqrt(0.1 * 0.9 / n));
  EXPECT_NEAR(early / n, 0.9 * 0.2, 0.015) << "a few short beams end within 7 cm of the wall";
}

}  // namespace
}  // namespace cairn
