#include "cairn/sim/world_sonar.hpp"

#include "simulated_scene.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

WorldSonarOptions clean_ring() {
  WorldSonarOptions o;
  o.transducers = 4;
  o.range_max_m = 12.0;
  o.sigma_range_m = o.sigma_share = o.lost_echo_share = o.crosstalk_share = 0.0;
  return o;
}

TEST(WorldSonar, TellsTheNearestOfTheCone) {
  const test::SimulatedScene scene([](WorldOptions&) {});
  const SonarScan scan = simulate_sonar(scene.view(), clean_ring());
  ASSERT_EQ(scan.ranges_m.size(), 4U);
  EXPECT_NEAR(scan.ranges_m[0], 6.8, 1e-3) << "the ring is 0.2 m wide";
  EXPECT_NEAR(scan.ranges_m[1], 4.8, 1e-3);
  EXPECT_NEAR(scan.ranges_m[2], 0.8, 1e-3);
  EXPECT_NEAR(scan.ranges_m[3], 0.8, 1e-3);
  EXPECT_NEAR(scan.T_sensor_transducer[1].y, 0.2, 1e-12);
}

// A wall that is hit at 45 degrees sends the sound on: to the wall north of it and back the same way.
TEST(WorldSonar, ASlantedSurfaceTurnsTheSoundAside) {
  const test::SimulatedScene scene([](WorldOptions& o) {
    o.walls.push_back({"slant", "2.5,0.5 3.5,1.5", false, "opaque", true});
  });
  WorldSonarOptions o = clean_ring();
  const auto echo = sonar_echo(scene.scene(), o, {1.0, 1.0}, 0.0);
  ASSERT_TRUE(echo.has_value());
  EXPECT_NEAR(*echo, 2.0 + 5.0, 1e-3) << "2 m to the slant, then 5 m up to the northern wall";
  o.critical_rad = 0.8;
  EXPECT_NEAR(*sonar_echo(scene.scene(), o, {1.0, 1.0}, 0.0), 2.0, 1e-3) << "a rough surface";
  o.critical_rad = 0.35;
  o.range_max_m = 5.0;
  EXPECT_FALSE(sonar_echo(scene.scene(), o, {1.0, 1.0}, 0.0).has_value()) << "too far";
}

TEST(WorldSonar, PeopleReturnFromAnyAngleAndGlassIsAWall) {
  const test::SimulatedScene crowd([](WorldOptions& o) { o.people.crowd = 4; });
  EXPECT_NEAR(*sonar_echo(crowd.scene(), clean_ring(), {1.0, 1.0}, 0.1), 0.7, 0.05);
  const test::SimulatedScene glass([](WorldOptions& o) {
    o.walls.push_back({"g", "3,0.5 3,1.5", false, "glass", true});
  });
  EXPECT_NEAR(*sonar_echo(glass.scene(), clean_ring(), {1.0, 1.0}, 0.1), 2.0 / std::cos(0.1), 1e-3);
}

// 4000 readings: shares and the deviation within 6 standard deviations of their estimates (alpha 2e-9 each).
TEST(WorldSonar, ErrorsAreAsFrequentAndAsLargeAsAsked) {
  const test::SimulatedScene scene([](WorldOptions&) {});
  WorldSonarOptions o = clean_ring();
  o.sigma_range_m = 0.02;
  o.lost_echo_share = 0.1;
  int lost = 0, heard = 0;
  double sum = 0.0, squares = 0.0;
  for (std::uint64_t index = 0; index < 4000; ++index) {
    const float range = simulate_sonar(scene.view(index), o).ranges_m[1];
    if (range >= 12.0F) {
      ++lost;
      continue;
    }
    ++heard;
    sum += range - 4.8;
    squares += (range - 4.8) * (range - 4.8);
  }
  EXPECT_NEAR(lost / 4000.0, 0.1, 6.0 * std::sqrt(0.1 * 0.9 / 4000.0));
  EXPECT_NEAR(sum / heard, 0.0, 6.0 * 0.02 / std::sqrt(heard));
  EXPECT_NEAR(std::sqrt(squares / heard), 0.02, 6.0 * 0.02 / std::sqrt(2.0 * heard));
}

}  // namespace
}  // namespace cairn
