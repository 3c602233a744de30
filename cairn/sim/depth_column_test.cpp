#include "cairn/sim/depth_column.hpp"

#include "simulated_scene.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr double kFocal_px = 50.0;
constexpr int kRows = 101;  // the middle one, 50, looks level

WorldDepthCameraOptions camera() {
  WorldDepthCameraOptions o;
  o.width = 101;
  o.height = kRows;
  o.height_m = 1.0;
  o.range_max_m = 20.0;
  return o;
}

// Depths of the rows that look along x from (1, 1).
std::vector<float> column_of(const std::function<void(WorldOptions&)>& change, double foreshortening = 1.0) {
  const test::SimulatedScene scene(change);
  DepthColumn column(camera(), kFocal_px, 2.8);
  const auto depths = column.cast(scene.scene(), {1.0, 1.0}, {1.0, 0.0}, foreshortening, 0.9);
  return {depths.begin(), depths.end()};
}

TEST(DepthColumn, AWallStandsBetweenFloorAndCeiling) {
  const auto depths = column_of([](WorldOptions&) {});
  EXPECT_NEAR(depths[50], 7.0, 1e-5);
  EXPECT_NEAR(depths[57], 7.0, 1e-5) << "down to row 50 + 50 * 1.0 / 7";
  EXPECT_NEAR(depths[58], 50.0 / 8.0, 1e-5) << "the floor before it";
  EXPECT_NEAR(depths[100], 1.0, 1e-5);
  EXPECT_NEAR(depths[38], 7.0, 1e-5) << "up to row 50 - 50 * 1.8 / 7";
  EXPECT_NEAR(depths[37], 50.0 * 1.8 / 13.0, 1e-5) << "the ceiling before it";
}

TEST(DepthColumn, DepthIsAlongTheOpticalAxis) {
  const auto depths = column_of([](WorldOptions&) {}, 0.5);
  EXPECT_NEAR(depths[50], 3.5, 1e-5);
}

TEST(DepthColumn, ABoxHasFrontAndLidAndWhatIsBehindItStandsAbove) {
  const auto depths = column_of([](WorldOptions& o) {
    o.furniture.push_back({"desk", "4,1", 2.0, 1.0, 0.0, "opaque", true, "", 0.0, 0.5});
  });
  EXPECT_NEAR(depths[75], 2.0, 1e-5) << "the floor ends at the front, 2 m away";
  EXPECT_NEAR(depths[63], 2.0, 1e-5) << "the front, up to row 50 + 50 * 0.5 / 2";
  EXPECT_NEAR(depths[60], 50.0 * 0.5 / 10.0, 1e-5) << "the lid";
  EXPECT_NEAR(depths[57], 50.0 * 0.5 / 7.0, 1e-5);
  EXPECT_NEAR(depths[56], 7.0, 1e-5) << "over the lid, which ends at 4 m: the wall";
}

TEST(DepthColumn, AShelfBoardHangs) {
  const auto depths = column_of([](WorldOptions& o) {
    o.furniture.push_back({"board", "4,1", 2.0, 1.0, 0.0, "opaque", true, "", 1.5, 1.6});
  });
  EXPECT_NEAR(depths[50], 7.0, 1e-5) << "under the board";
  EXPECT_NEAR(depths[36], 2.0, 1e-5) << "its front: rows 50 - 50 * 0.6 / 2 to 50 - 50 * 0.5 / 2";
  EXPECT_NEAR(depths[40], 50.0 * 0.5 / 10.0, 1e-5) << "its lower side";
}

TEST(DepthColumn, GlassIsSeenHeadOnAndAMirrorShowsTheRoom) {
  const auto with = [](const char* points, const char* material) {
    return column_of([=](WorldOptions& o) { o.walls.push_back({"w", points, false, material, true}); });
  };
  EXPECT_NEAR(with("3,0.5 3,1.5", "glass")[50], 2.0, 1e-5);
  EXPECT_NEAR(with("2.8,0.5 3.2,1.5", "glass")[50], 7.0, 1e-4) << "through slanted glass";
  EXPECT_NEAR(with("3,0.5 3,1.5", "mirror")[50], 2.0 + 3.0, 1e-4) << "there and back to the western wall";
  EXPECT_NEAR(with("3,0.5 3,1.5", "mesh")[50], 7.0, 1e-4);
}

TEST(DepthColumn, PeopleEndAtTheirHeight) {
  const auto depths = column_of([](WorldOptions& o) {
    o.people.crowd = 4;
    o.people.crowd_distance_m = 2.22;
    o.people.height_m = 1.5;
  });
  EXPECT_NEAR(depths[50], 2.0, 1e-4);
  EXPECT_NEAR(depths[38], 2.0, 1e-4) << "up to row 50 - 50 * 0.5 / 2";
  EXPECT_GT(depths[37], 5.0F) << "over the head";
}

}  // namespace
}  // namespace cairn
