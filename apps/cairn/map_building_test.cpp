#include "apps/cairn/map_building.hpp"

#include "cairn/core/errors.hpp"

#include <gtest/gtest.h>

namespace cairn::app {
namespace {

std::shared_ptr<const LaserScan> three_beams() {
  LaserScan scan;
  scan.angle_min_rad = -0.1;
  scan.angle_increment_rad = 0.1;
  scan.range_max_m = 50.0;
  scan.ranges_m = {80.0f, 2.0f, 80.0f};  // one return straight ahead
  return std::make_shared<const LaserScan>(scan);
}

/// Scans at 0, 1, .. 4 s on stream 1.
Log five_scans() {
  Log log;
  log.streams = {{"odom", StreamKind::kOdometry, "", {}}, {"laser", StreamKind::kLaserScan, "", {}}};
  for (int i = 0; i < 5; ++i) {
    const Time stamp = time_from_seconds(i);
    log.events.push_back({stamp, stamp, 1, three_beams()});
  }
  return log;
}

Trajectory from_0_to_4() {
  return {{time_from_seconds(0), {0.05, 0.05, 0}}, {time_from_seconds(4), {4.05, 0.05, 0}}};
}

MapBuildingOptions options() {
  MapBuildingOptions o;
  o.grid.resolution_m = 0.1;
  o.grid.uncleared_m = 0.0;
  o.scans.T_base_sensor = Pose2{0.5, 0.0, 0.0};
  o.scans.max_gap_s = 10.0;
  return o;
}

void no_progress(double) {}

TEST(BuildMap, PutsEveryScanWhereThePathSays) {
  const BuiltMap map = build_map(five_scans(), from_0_to_4(), options(), no_progress);
  EXPECT_EQ(map.scans_used, 5u);
  EXPECT_EQ(map.grid.geometry().height, 1);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(map.grid.state_at({i + 2.55, 0.05}), CellState::kOccupied) << i;
  EXPECT_EQ(map.grid.state_at({0.65, 0.05}), CellState::kFree);
  EXPECT_EQ(map.grid.state_at({0.45, 0.05}), CellState::kUnknown);
}

TEST(BuildMap, APathOfTheSensorNeedsNoMount) {
  MapBuildingOptions o = options();
  o.scans.trajectory_is_of_sensor = true;
  const BuiltMap map = build_map(five_scans(), from_0_to_4(), o, no_progress);
  EXPECT_EQ(map.grid.state_at({2.05, 0.05}), CellState::kOccupied);
}

TEST(BuildMap, TakesTheMountOfTheLogOrAsksForOne) {
  MapBuildingOptions o = options();
  o.scans.T_base_sensor = std::nullopt;
  Log log = five_scans();
  EXPECT_THROW(build_map(log, from_0_to_4(), o, no_progress), ConfigurationError);
  log.streams[1].T_base_sensor = Pose2{0.5, 0, 0};
  EXPECT_EQ(build_map(log, from_0_to_4(), o, no_progress).grid.state_at({2.55, 0.05}), CellState::kOccupied);
}

TEST(BuildMap, CountsScansWithoutPose) {
  MapBuildingOptions o = options();
  o.scans.max_gap_s = 1.0;  // the two poses are 4 s apart: only the scans at their very stamps have one
  const BuiltMap map = build_map(five_scans(), from_0_to_4(), o, no_progress);
  EXPECT_EQ(map.scans_used, 2u);
  EXPECT_EQ(map.scans_without_pose, 3u);
  const Trajectory later = {{time_from_seconds(100), {}}, {time_from_seconds(101), {}}};
  EXPECT_THROW(build_map(five_scans(), later, o, no_progress), InputError);
}

TEST(LaserStream, IsTheNamedOrTheOnlyOne) {
  Log log = five_scans();
  EXPECT_EQ(laser_stream(log, ""), 1);
  EXPECT_EQ(laser_stream(log, "laser"), 1);
  EXPECT_THROW(laser_stream(log, "odom"), ConfigurationError);
  log.streams.push_back({"rear", StreamKind::kLaserScan, "", {}});
  EXPECT_THROW(laser_stream(log, ""), ConfigurationError);
  EXPECT_EQ(laser_stream(log, "rear"), 2);
  EXPECT_EQ(stamps_of(log, 1).size(), 5u);
  EXPECT_THROW(laser_stream(Log{}, ""), InputError);
}

}  // namespace
}  // namespace cairn::app
