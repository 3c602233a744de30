#include "cairn/sim/world_ceiling.hpp"

#include "simulated_scene.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

WorldCeilingCameraOptions exact_camera() {
  WorldCeilingCameraOptions o;
  o.pixels = 16;
  o.side_m = 1.6;
  o.sigma_gray = o.sigma_exposure = 0.0;
  return o;
}

TEST(WorldCeiling, APatchShowsTheCeilingAboveTheCamera) {
  const test::SimulatedScene scene([](WorldOptions& o) { o.robot.start = "2,3,1.5707963267948966"; });
  const CeilingPatch patch = simulate_ceiling(scene.view(), exact_camera());
  ASSERT_EQ(patch.gray.size(), 256U);
  EXPECT_NEAR(patch.metres_per_pixel, 0.1, 1e-12);
  // The robot looks along y of the map: the top row is ahead of it, the left column in negative x of the map.
  const auto gray = [&](double x, double y) {
    return std::lround(ceiling_gray(scene.options().ceiling, {x, y}));
  };
  EXPECT_EQ(patch.gray[0], gray(2.0 - 0.75, 3.0 + 0.75));
  EXPECT_EQ(patch.gray[15], gray(2.0 + 0.75, 3.0 + 0.75));
  EXPECT_EQ(patch.gray[16 * 15], gray(2.0 - 0.75, 3.0 - 0.75));
}

TEST(WorldCeiling, ThePatternHasTilesJointsAndLamps) {
  WorldCeilingOptions o;
  EXPECT_EQ(ceiling_gray(o, {0.0, 0.3}), ceiling_gray(o, {0.6, 0.3})) << "joints";
  int lamps = 0;
  double least = 255.0, most = 0.0;
  for (int column = -50; column < 50; ++column) {
    for (int row = -50; row < 50; ++row) {
      const double gray = ceiling_gray(o, {0.6 * column + 0.3, 0.6 * row + 0.3});
      lamps += gray > 240.0 ? 1 : 0;
      least = std::min(least, gray);
      most = std::max(most, gray);
    }
  }
  EXPECT_NEAR(lamps / 1e4, 0.06, 6.0 * std::sqrt(0.06 * 0.94 / 1e4)) << "alpha 2e-9";
  EXPECT_GT(least, 100.0);
  EXPECT_LE(most, 255.0);
}

// Places are told apart: patches of the same place agree, others do not.
TEST(WorldCeiling, IsTheSameForTheSamePlaceAndPatternOnly) {
  WorldCeilingOptions o, other;
  other.pattern = 2;
  double same = 0.0, moved = 0.0;
  for (double x = -3.0; x < 3.0; x += 0.17) {
    for (double y = -3.0; y < 3.0; y += 0.17) {
      EXPECT_EQ(ceiling_gray(o, {x, y}), ceiling_gray(o, {x, y}));
      same += std::abs(ceiling_gray(o, {x, y}) - ceiling_gray(other, {x, y}));
      moved += std::abs(ceiling_gray(o, {x, y}) - ceiling_gray(o, {x + 6.0, y}));
    }
  }
  EXPECT_GT(same, 1000.0);
  EXPECT_GT(moved, 1000.0);
}

// 100 pictures of 256 pixels, none near black or white: within 6 standard deviations (alpha 2e-9 each;
// rounding to whole greys adds 1/12).
TEST(WorldCeiling, NoiseAndExposureAreAsLargeAsAsked) {
  const test::SimulatedScene scene([](WorldOptions& o) { o.ceiling.lamp_share = 0.0; });
  WorldCeilingCameraOptions o = exact_camera();
  const CeilingPatch truth = simulate_ceiling(scene.view(), o);
  o.sigma_gray = 4.0;
  double squares = 0.0;
  for (std::uint64_t index = 0; index < 100; ++index) {
    const CeilingPatch patch = simulate_ceiling(scene.view(index), o);
    for (std::size_t i = 0; i < 256; ++i) squares += std::pow(patch.gray[i] - truth.gray[i], 2.0);
  }
  EXPECT_NEAR(squares / 25600.0, 16.0 + 1.0 / 6.0, 16.0 * 6.0 * std::sqrt(2.0 / 25600.0) + 0.1);
  o.sigma_gray = 0.0;
  o.sigma_exposure = 0.1;
  double exposures = 0.0;
  for (std::uint64_t index = 0; index < 400; ++index) {
    const CeilingPatch patch = simulate_ceiling(scene.view(index), o);
    double sum = 0.0, expected = 0.0;
    for (std::size_t i = 0; i < 256; ++i) sum += patch.gray[i], expected += truth.gray[i];
    exposures += std::pow(sum / expected - 1.0, 2.0);
  }
  EXPECT_NEAR(std::sqrt(exposures / 400.0), 0.1, 0.1 * 6.0 / std::sqrt(800.0));
}

}  // namespace
}  // namespace cairn
