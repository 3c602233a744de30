#include "cairn/sim/world_depth_camera.hpp"

#include "simulated_scene.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace cairn {
namespace {

WorldDepthCameraOptions small_camera() {
  WorldDepthCameraOptions o;
  o.width = 80;
  o.height = 60;
  o.range_max_m = 10.0;
  o.missing_share = 0.0;
  return o;
}

// Its disparities are so fine that nothing is rounded but millimetres.
WorldDepthCameraOptions exact_camera() {
  WorldDepthCameraOptions o = small_camera();
  o.sigma_disparity_px = 0.0;
  o.disparity_step_px = 0.001;
  o.baseline_m = 1.0;
  o.shadows = false;
  return o;
}

// What a pixel's ray meets, by trying all walls in three dimensions: its depth.
double reference_depth(const World& world, const Pose2& T_map_camera, const WorldDepthCameraOptions& o,
                       int column, int row) {
  const PinholeIntrinsics k = intrinsics_of(o);
  const Point2 origin{T_map_camera.x, T_map_camera.y};
  const Point2 ahead = T_map_camera * Point2{1.0, -(column - k.cx_px) / k.fx_px};
  const Point2 d{ahead.x - origin.x, ahead.y - origin.y};  // for each metre of depth
  const double fall = (row - k.cy_px) / k.fy_px;
  double nearest = fall > 0.0 ? o.height_m / fall : (o.height_m - world.options.ceiling.height_m) / fall;
  for (std::size_t i = 0; i < world.solid->walls().size(); ++i) {
    const Wall& wall = world.solid->walls()[i];
    const Point2 e{wall.b.x - wall.a.x, wall.b.y - wall.a.y}, w{wall.a.x - origin.x, wall.a.y - origin.y};
    const double det = d.x * e.y - d.y * e.x;
    const double depth = (w.x * e.y - w.y * e.x) / det, along = (w.x * d.y - w.y * d.x) / det;
    if (depth <= 0.0 || along < 0.0 || along > 1.0) continue;
    if (world.spans[i].contains(o.height_m - fall * depth)) nearest = std::min(nearest, depth);
  }
  return nearest;
}

TEST(WorldDepthCamera, AgreesWithTracingEveryPixelInThreeDimensions) {
  const test::SimulatedScene scene([](WorldOptions& o) {
    o.robot.start = "1,1,0.4";
    o.walls.push_back({"low", "5,1 6,4", false, "opaque", true, 0.9});
    o.walls.push_back({"pillar", "3,3 3.2,3", false, "opaque", true});
  });
  const WorldDepthCameraOptions o = exact_camera();
  const DepthImage image = simulate_depth_image(scene.view(), o);
  int edges = 0, pixels = 0;
  for (int row = 0; row < o.height; ++row) {
    for (int column = 0; column < o.width; ++column, ++pixels) {
      const double expected = reference_depth(scene.drive().world, scene.drive().world.start, o, column, row);
      edges += std::abs(image.depth_m(column, row) - expected) < 0.002 ? 0 : 1;
    }
  }
  EXPECT_LE(edges, pixels / 500) << "rounding decides at edges only";
}

TEST(WorldDepthCamera, TellsNothingBeyondItsLimits) {
  const test::SimulatedScene scene([](WorldOptions&) {});
  WorldDepthCameraOptions o = exact_camera();
  o.range_max_m = 6.0;
  EXPECT_TRUE(std::isnan(simulate_depth_image(scene.view(), o).depth_m(40, 30))) << "the wall is 7 m away";
  o.range_max_m = 8.0;
  EXPECT_NEAR(simulate_depth_image(scene.view(), o).depth_m(40, 30), 7.0, 0.002);
  o.range_min_m = 7.5;
  EXPECT_TRUE(std::isnan(simulate_depth_image(scene.view(), o).depth_m(40, 30)));
}

// A pillar 2 m away before a wall 7 m away: left of it lies a strip of the wall that the projector, to the
// right of the lens, does not reach. It is focal * baseline * (1/2 - 1/7) wide.
TEST(WorldDepthCamera, ThePillarThrowsAShadowToTheLeft) {
  const test::SimulatedScene scene([](WorldOptions& o) {
    o.walls.push_back({"pillar", "3,0.9 3,1.1", false, "opaque", true});
  });
  WorldDepthCameraOptions o = exact_camera();
  o.shadows = true;
  o.baseline_m = 0.2;
  const DepthImage image = simulate_depth_image(scene.view(), o);
  int before = 0, behind = 0, first_pillar = -1;
  for (int column = 0; column < o.width; ++column) {
    const double depth = image.depth_m(column, 30);
    if (first_pillar < 0 && depth < 3.0) first_pillar = column;
    if (!std::isnan(depth)) continue;
    (first_pillar < 0 ? before : behind) += 1;
  }
  const double width_px = intrinsics_of(o).fx_px * o.baseline_m * (0.5 - 1.0 / 7.0);
  EXPECT_NEAR(before, width_px, 1.5);
  EXPECT_EQ(behind, 0);
}

TEST(WorldDepthCamera, DisparitiesAreWholeSteps) {
  const test::SimulatedScene scene([](WorldOptions&) {});
  WorldDepthCameraOptions o = small_camera();
  o.shadows = false;
  const DepthImage image = simulate_depth_image(scene.view(), o);
  const double step_m = intrinsics_of(o).fx_px * o.baseline_m / o.disparity_step_px;
  for (int row = 0; row < o.height; ++row) {
    const double depth = image.depth_m(40, row);
    if (std::isnan(depth)) continue;
    // Rounding to a millimetre moves the disparity by step_m / depth^2 * 0.5 mm.
    const double steps = step_m / depth;
    EXPECT_NEAR(steps, std::round(steps), 0.0006 * step_m / (depth * depth) + 1e-6);
  }
}

// Deviation of the depths of a wall at 2 and at 4 m: noise and rounding together, sigma^2 = (z^2 / (f b))^2 *
// (sigma_d^2 + step^2 / 12). 40 images x 80 pixels: within 6 standard deviations (alpha 2e-9), and 10 % for
// what rounding adds: it is not independent of a noise of a third of a step.
TEST(WorldDepthCamera, NoiseGrowsWithTheSquareOfDepth) {
  for (const double depth_m : {2.0, 4.0}) {
    const test::SimulatedScene scene([&](WorldOptions& o) {
      const std::string x = std::to_string(1.0 + depth_m);
      o.walls.push_back({"w", x + ",0.1 " + x + ",5.9", false, "opaque", true});
    });
    WorldDepthCameraOptions o = small_camera();
    o.baseline_m = 0.6;  // fine steps: the small image has a short focal length
    o.shadows = false;
    double squares = 0.0;
    int count = 0;
    for (std::uint64_t index = 0; index < 40; ++index) {
      const DepthImage image = simulate_depth_image(scene.view(index), o);
      for (int column = 30; column < 50; ++column) {
        for (int row = 28; row < 32; ++row, ++count)
          squares += std::pow(image.depth_m(column, row) - depth_m, 2.0);
      }
    }
    const double per_px = depth_m * depth_m / (intrinsics_of(o).fx_px * o.baseline_m);
    const double sigma =
        per_px * std::sqrt(std::pow(o.sigma_disparity_px, 2.0) + std::pow(o.disparity_step_px, 2.0) / 12.0);
    EXPECT_NEAR(std::sqrt(squares / count), sigma, sigma * (0.1 + 6.0 / std::sqrt(2.0 * count))) << depth_m;
  }
}

// 40 x 4800 pixels: within 6 standard deviations (alpha 2e-9).
TEST(WorldDepthCamera, LosesTheShareOfPixelsThatIsAsked) {
  const test::SimulatedScene scene([](WorldOptions&) {});
  WorldDepthCameraOptions o = exact_camera();
  o.missing_share = 0.03;
  int missing = 0, pixels = 0;
  for (std::uint64_t index = 0; index < 40; ++index) {
    const DepthImage image = simulate_depth_image(scene.view(index), o);
    for (int row = 20; row < 40; ++row) {
      for (int column = 0; column < o.width; ++column, ++pixels)
        missing += std::isnan(image.depth_m(column, row)) ? 1 : 0;
    }
  }
  EXPECT_NEAR(missing / static_cast<double>(pixels), 0.03, 6.0 * std::sqrt(0.03 * 0.97 / pixels));
}

TEST(WorldDepthCamera, APictureIsAFunctionOfItsIndex) {
  const test::SimulatedScene scene([](WorldOptions&) {});
  const auto pixels = [&](std::uint64_t index) {
    return std::get<DepthImage::Millimetres>(simulate_depth_image(scene.view(index), small_camera()).depths);
  };
  EXPECT_EQ(pixels(3), pixels(3));
  EXPECT_NE(pixels(3), pixels(4));
}

TEST(WorldDepthCamera, TakesPicturesOfAnyHeight) {
  const test::SimulatedScene scene([](WorldOptions&) {});
  WorldDepthCameraOptions o = exact_camera();
  o.width = 17;
  o.height = 1001;  // more rows than one batch of random numbers has
  const DepthImage image = simulate_depth_image(scene.view(), o);
  EXPECT_EQ(image.pixels(), 17017U);
  EXPECT_NEAR(image.depth_m(8, 500), 7.0, 0.002);
  EXPECT_NEAR(image.depth_m(8, 515), reference_depth(scene.drive().world, {1.0, 1.0, 0.0}, o, 8, 515), 0.002);
}

}  // namespace
}  // namespace cairn
