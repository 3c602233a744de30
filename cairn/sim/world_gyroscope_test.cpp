#include "cairn/sim/world_gyroscope.hpp"

#include "simulated_scene.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

WorldGyroscopeOptions exact_gyroscope() {
  WorldGyroscopeOptions o;
  o.sigma_radps = o.sigma_bias_radps = o.sigma_scale = 0.0;
  return o;
}

TEST(WorldGyroscope, TellsTheRateOfTurnButNotAKidnapping) {
  const test::SimulatedScene scene([](WorldOptions&) {});
  Trajectory truth;
  for (int i = 0; i <= 100; ++i) {
    const double heading =
        i < 50 ? 0.02 * i : 3.0 + 0.01 * (i - 50);  // carried away to step 50; turns over pi
    truth.push_back({time_from_seconds(0.02 * i), {0.0, 0.0, std::remainder(heading, 6.283185307179586)}});
  }
  const SimulatedDrive& d = scene.drive();
  const SimulatedDrive drive{d.world, d.walls, d.people, truth, 1, 50};
  EXPECT_NEAR(true_yaw_rate(drive, Time{}), 1.0, 1e-9);
  EXPECT_NEAR(true_yaw_rate(drive, time_from_seconds(0.99)), 1.0, 1e-9);
  EXPECT_NEAR(true_yaw_rate(drive, time_from_seconds(1.5)), 0.5, 1e-9);
  EXPECT_NEAR(true_yaw_rate(drive, time_from_seconds(2.0)), 0.5, 1e-9);
  const SensorView view{drive, 0, 75, time_from_seconds(1.5), Time{}};
  const GyroscopeErrors errors = draw_gyroscope_errors(exact_gyroscope(), 0, 101, 1);
  EXPECT_NEAR(simulate_gyroscope(view, exact_gyroscope(), errors).yaw_rate_radps, 0.5, 1e-9);
}

// 3000 readings of a robot that stands; within 6 standard deviations of the estimates (alpha 2e-9 each).
TEST(WorldGyroscope, ReadingsHaveNoise) {
  const test::SimulatedScene scene([](WorldOptions&) {});
  WorldGyroscopeOptions o = exact_gyroscope();
  o.sigma_radps = 0.01;
  const GyroscopeErrors errors = draw_gyroscope_errors(o, 0, 10, 1);
  double sum = 0.0, squares = 0.0;
  for (std::uint64_t index = 0; index < 3000; ++index) {
    const double rate = simulate_gyroscope(scene.view(index), o, errors).yaw_rate_radps;
    sum += rate;
    squares += rate * rate;
  }
  EXPECT_NEAR(sum / 3000.0, 0.0, 6.0 * 0.01 / std::sqrt(3000.0));
  EXPECT_NEAR(std::sqrt(squares / 3000.0), 0.01, 6.0 * 0.01 / std::sqrt(6000.0));
}

// 2000 gyroscopes: bias, its walk after 4 s, and scale; within 6 standard deviations of the estimates (alpha
// 2e-9).
TEST(WorldGyroscope, BiasWalksAndScaleIsDrawnOnce) {
  WorldGyroscopeOptions o = exact_gyroscope();
  o.sigma_bias_radps = 0.02;
  o.bias_walk_radps_per_sqrt_s = 0.003;
  o.sigma_scale = 0.01;
  double bias = 0.0, walk = 0.0, scale = 0.0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const GyroscopeErrors errors = draw_gyroscope_errors(o, 0, 201, seed);
    bias += std::pow(errors.bias_radps[0], 2.0) / 2000.0;
    walk += std::pow(errors.bias_radps[200] - errors.bias_radps[0], 2.0) / 2000.0;
    scale += std::pow(errors.scale - 1.0, 2.0) / 2000.0;
  }
  const double relative = 6.0 / std::sqrt(4000.0);
  EXPECT_NEAR(std::sqrt(bias), 0.02, 0.02 * relative);
  EXPECT_NEAR(std::sqrt(walk), 0.003 * 2.0, 0.006 * relative);
  EXPECT_NEAR(std::sqrt(scale), 0.01, 0.01 * relative);
}

}  // namespace
}  // namespace cairn
