#include "cairn/sim/radio_field.hpp"

#include "simulated_scene.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// 4000 fields: the variance and the correlation at two distances, within 6 standard deviations of their
// estimates (alpha 2e-9 each; the variance of a product of two such numbers is at most twice sigma^4).
TEST(ShadowingField, HasTheVarianceAndTheCorrelationThatAreAsked) {
  constexpr int kFields = 4000;
  double variance = 0.0, near = 0.0, far = 0.0, mean = 0.0;
  for (std::uint64_t number = 0; number < kFields; ++number) {
    const ShadowingField field(3.0, 2.0, 7, number);
    const double here = field.at({1.0, 4.0});
    mean += here / kFields;
    variance += here * here / kFields;
    near += here * field.at({2.2, 5.6}) / kFields;  // 2 m away
    far += here * field.at({1.0, 14.0}) / kFields;  // 10 m away
  }
  const double tolerance = 6.0 * std::sqrt(2.0) * 9.0 / std::sqrt(kFields);
  EXPECT_NEAR(mean, 0.0, 6.0 * 3.0 / std::sqrt(kFields));
  EXPECT_NEAR(variance, 9.0, tolerance);
  EXPECT_NEAR(near, 9.0 * std::exp(-1.0), tolerance);
  EXPECT_NEAR(far, 9.0 * std::exp(-5.0), tolerance);
}

TEST(ShadowingField, IsTheSameWheneverOneComesBack) {
  const ShadowingField a(3.0, 2.0, 7, 1), b(3.0, 2.0, 7, 1), other(3.0, 2.0, 7, 2), seed(3.0, 2.0, 8, 1);
  EXPECT_EQ(a.at({1.0, 2.0}), b.at({1.0, 2.0}));
  EXPECT_NE(a.at({1.0, 2.0}), other.at({1.0, 2.0}));
  EXPECT_NE(a.at({1.0, 2.0}), seed.at({1.0, 2.0}));
  EXPECT_NEAR(a.at({1.0, 2.0}), a.at({1.0001, 2.0}), 0.2) << "it has no jumps";
}

TEST(ReceivedLevel, FallsWithTheLogarithmOfTheDistance) {
  const test::SimulatedScene scene([](WorldOptions& o) { o.radio.path_loss_exponent = 2.0; });
  const WorldRadioOptions& radio = scene.options().radio;
  const auto level = [&](double x) {
    return received_level_dbm(scene.scene(), radio, {x, 1.0}, -40.0, {1.0, 1.0});
  };
  EXPECT_NEAR(level(2.0), -40.0, 1e-9);
  EXPECT_NEAR(level(6.0), -40.0 - 20.0 * std::log10(5.0), 1e-9);
  EXPECT_LT(level(1.0), 0.0) << "no infinity on top of it";
}

TEST(ReceivedLevel, LosesForEachWallDoorAndPerson) {
  const auto loss = [](const std::function<void(WorldOptions&)>& change) {
    const test::SimulatedScene open([](WorldOptions&) {}), scene(change);
    const auto level = [](const test::SimulatedScene& s) {
      return received_level_dbm(s.scene(), s.options().radio, {6.0, 1.0}, -40.0, {1.0, 1.0});
    };
    return level(open) - level(scene);
  };
  const auto wall = [&](const char* material, double height_m = 0.0) {
    return loss([=](WorldOptions& o) {
      o.walls.push_back({"w", "3,0.5 3,1.5", false, material, true, height_m});
    });
  };
  EXPECT_NEAR(wall("opaque"), 5.0, 1e-9);
  EXPECT_NEAR(wall("glass"), 2.0, 1e-9);
  EXPECT_NEAR(wall("mesh"), 6.0, 1e-9);
  EXPECT_NEAR(wall("mirror"), 8.0, 1e-9);
  EXPECT_NEAR(wall("opaque", 0.5), 0.0, 1e-9) << "below the antennas";
  EXPECT_NEAR(loss([](WorldOptions& o) {
                o.doors.push_back({"d", "3,0.5", "3,1.5", 5.0, 5.0, 7.0, false});
              }),
              3.0, 1e-9);
  EXPECT_NEAR(loss([](WorldOptions& o) {
                o.people.crowd = 2;
                o.people.crowd_distance_m = 2.0;
              }),
              3.0, 1e-9)
      << "one of the two stands on the line";
}

TEST(ReceivedLevel, CountsWalls) {
  const test::SimulatedScene scene([](WorldOptions& o) {
    o.walls.push_back({"a", "3,0.5 3,1.5", false, "opaque", true});
    o.walls.push_back({"b", "4,0.5 4,1.5", false, "glass", true});
    o.people.crowd = 2;
  });
  EXPECT_EQ(walls_on_line(scene.scene(), {1.0, 1.0}, {6.0, 1.0}), 2);
  EXPECT_EQ(walls_on_line(scene.scene(), {1.0, 1.0}, {1.0, 1.0}), 0);
}

}  // namespace
}  // namespace cairn
