#include "cairn/sim/mission.hpp"

#include "cairn/core/errors.hpp"
#include "small_world.hpp"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace cairn {
namespace {

RobotDrive driven(const std::function<void(WorldOptions&)>& change, std::uint64_t seed = 1) {
  WorldOptions options = test::small_world_options();
  options.walls.push_back({"divider", "0,3 6,3", false, "opaque", true});
  change(options);
  return drive_mission(make_world(options), seed);
}

std::string refusal(const std::function<void(WorldOptions&)>& change) {
  try {
    driven(change);
  } catch (const ConfigurationError& error) {
    return error.where();
  }
  return "accepted";
}

bool comes_near(const Trajectory& truth, const Point2& p) {
  for (const StampedPose& s : truth) {
    if (std::hypot(s.pose.x - p.x, s.pose.y - p.y) < 0.12) return true;
  }
  return false;
}

TEST(Mission, WaypointsAreReachedAroundWalls) {
  const Trajectory truth = driven([](WorldOptions& o) { o.robot.points = "7,1 1,5"; }).truth;
  EXPECT_TRUE(comes_near(truth, {7.0, 1.0}));
  EXPECT_TRUE(comes_near(truth, {1.0, 5.0}));
  for (const StampedPose& s : truth) EXPECT_FALSE(s.pose.x < 5.9 && std::abs(s.pose.y - 3.0) < 0.2);
}

TEST(Mission, ALongDriveGoesRoundAndRound) {
  const Trajectory truth = driven([](WorldOptions& o) {
                             o.robot.points = "1,5";
                             o.robot.duration_s = 100.0;
                           }).truth;
  EXPECT_EQ(truth.back().stamp, time_from_seconds(100.0));
  for (const StampedPose& s : truth) EXPECT_FALSE(s.pose.x < 5.9 && std::abs(s.pose.y - 3.0) < 0.2);
}

// Only as much of the way is planned as can be driven: that must not show.
TEST(Mission, AShortDriveIsTheBeginningOfALongOne) {
  for (const char* mission : {"waypoints", "random", "coverage"}) {
    const auto drive = [mission](double seconds) {
      return driven([mission, seconds](WorldOptions& o) {
               o.robot.mission = mission;
               o.robot.points = "7,1 1,5 7,5 1,1 4,5";
               o.robot.duration_s = seconds;
             })
          .truth;
    };
    const Trajectory few = drive(13.0), many = drive(120.0);
    ASSERT_LT(few.size(), many.size());
    for (std::size_t i = 0; i < few.size(); ++i) ASSERT_EQ(few[i].pose, many[i].pose) << mission << " " << i;
  }
}

TEST(Mission, ThroughWallsIsRefused) {
  EXPECT_EQ(refusal([](WorldOptions& o) { o.robot.points = "0,5"; }), "robot.points") << "in a wall";
  EXPECT_EQ(refusal([](WorldOptions& o) { o.robot.points = "1,50"; }), "robot.points") << "outside";
  EXPECT_EQ(refusal([](WorldOptions& o) { o.robot.points = ""; }), "robot.points");
  EXPECT_EQ(refusal([](WorldOptions& o) {
              o.robot.mission = "polyline";
              o.robot.points = "1,5";
            }),
            "robot.points")
      << "through the divider";
  EXPECT_EQ(refusal([](WorldOptions& o) { o.walls[1].points = "0,3 8,3"; }), "robot.points") << "no way";
}

TEST(Mission, RandomDrivesDifferBySeedOnly) {
  const auto random = [](WorldOptions& o) { o.robot.mission = "random"; };
  const RobotDrive drive = driven(random, 1);
  EXPECT_EQ(drive.truth, driven(random, 1).truth);
  EXPECT_NE(drive.truth, driven(random, 2).truth);
  EXPECT_EQ(drive.truth.back().stamp, time_from_seconds(60.0));
}

TEST(Mission, ARandomDriveBeginsAnywhereIfAsked) {
  const auto anywhere = [](WorldOptions& o) {
    o.robot.mission = "random";
    o.robot.random_start = true;
  };
  const Trajectory first = driven(anywhere, 1).truth, second = driven(anywhere, 2).truth;
  EXPECT_EQ(first, driven(anywhere, 1).truth);
  EXPECT_GT(distance(first.front().pose, second.front().pose), 0.01);
  EXPECT_NE(first.front().pose.theta, second.front().pose.theta);
  EXPECT_EQ(first.front().stamp, Time{});
  EXPECT_EQ(refusal([](WorldOptions& o) { o.robot.random_start = true; }), "robot.random_start");
}

TEST(Mission, CoverageComesNearEverything) {
  const Trajectory truth = driven([](WorldOptions& o) {
                             o.robot.mission = "coverage";
                             o.robot.spacing_m = 1.0;
                           }).truth;
  for (double x = 0.75; x < 7.5; x += 0.5) {
    for (double y : {0.75, 1.75, 2.25, 3.75, 4.75, 5.25}) {
      double nearest = 1e9;
      for (const StampedPose& s : truth) nearest = std::min(nearest, std::hypot(s.pose.x - x, s.pose.y - y));
      EXPECT_LT(nearest, 0.8) << x << " " << y;
    }
  }
}

TEST(Mission, AnOmnidirectionalRobotMovesSideways) {
  const Trajectory truth = driven([](WorldOptions& o) { o.robot.drive = "omnidirectional"; }).truth;
  double most_sideways = 0.0;
  for (std::size_t i = 1; i < truth.size(); ++i) {
    most_sideways = std::max(most_sideways, std::abs(between(truth[i - 1].pose, truth[i].pose).y));
  }
  EXPECT_GT(most_sideways, 0.005);
}

TEST(Mission, AKidnappedRobotGoesOnFromElsewhere) {
  const auto kidnapping = [](WorldOptions& o) {
    o.robot.kidnap_at_s = 5.0;
    o.robot.kidnap_to = "2,5,1.5";
  };
  const RobotDrive drive = driven(kidnapping);
  ASSERT_GT(drive.kidnapped_to, 0U);
  EXPECT_EQ(drive.truth[drive.kidnapped_to].stamp, time_from_seconds(5.0));
  EXPECT_EQ(drive.truth[drive.kidnapped_to].pose, (Pose2{2.0, 5.0, 1.5}));
  for (std::size_t i = 1; i < drive.truth.size(); ++i)
    EXPECT_LT(drive.truth[i - 1].stamp, drive.truth[i].stamp);
  EXPECT_EQ(refusal([](WorldOptions& o) {
              o.robot.kidnap_at_s = 5.0;
              o.robot.kidnap_to = "-1,5,0";
            }),
            "robot.kidnap_to");
}

World recorded_world(
    const Trajectory& path, const std::function<void(WorldOptions&)>& change = [](WorldOptions&) {}) {
  WorldOptions options = test::small_world_options();
  options.walls.push_back({"divider", "0,3 6,3", false, "opaque", true});
  options.robot.mission = "recorded";
  change(options);
  return make_world(options, {}, path);
}

TEST(Mission, ARecordedDriveIsRepeated) {
  const Time start = time_from_seconds(1e9);
  const Trajectory path{{start, {1, 1, 0}},
                        {start + std::chrono::seconds(2), {3, 1, 0}},
                        {start + std::chrono::seconds(3), {3, 1, 1}}};
  const Trajectory truth = drive_mission(recorded_world(path), 1).truth;
  ASSERT_EQ(truth.size(), 151U) << "50 poses a second";
  EXPECT_EQ(truth.front(), (StampedPose{Time{}, {1, 1, 0}}));
  EXPECT_NEAR(truth[50].pose.x, 2.0, 1e-9);
  EXPECT_NEAR(truth.back().pose.theta, 1.0, 1e-9);
  EXPECT_EQ(
      drive_mission(recorded_world(path, [](WorldOptions& o) { o.robot.duration_s = 1.0; }), 1).truth.size(),
      51U);
}

TEST(Mission, ARecordedDriveThroughAWallIsRefused) {
  const auto where = [](
                         const Trajectory& path,
                         const std::function<void(WorldOptions&)>& change = [](WorldOptions&) {}) {
    try {
      drive_mission(recorded_world(path, change), 1);
    } catch (const ConfigurationError& error) {
      return error.where();
    }
    return std::string("accepted");
  };
  const Time end = time_from_seconds(4);
  EXPECT_EQ(where({{Time{}, {1, 2, 0}}, {end, {1, 4, 0}}}), "robot.path");
  EXPECT_EQ(where({{Time{}, {1, 2, 0}}}), "robot.path") << "one pose is no path";
  EXPECT_EQ(where({}), "robot.path");
  EXPECT_EQ(where({{Time{}, {1, 2, 0}}, {time_from_seconds(1e6), {2, 2, 0}}}), "robot.path") << "ten days";
  const Trajectory good{{Time{}, {1, 0.1, 0}}, {end, {2, 0.1, 0}}};
  EXPECT_EQ(where(good), "accepted") << "nearer to a wall than the radius, but the robot was there";
  EXPECT_EQ(where(good, [](WorldOptions& o) { o.robot.kidnap_at_s = 1.0; }), "robot.kidnap_at_s");
}

}  // namespace
}  // namespace cairn
