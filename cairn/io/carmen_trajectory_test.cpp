#include "cairn/io/carmen_trajectory.hpp"

#include "bad_input.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using test::error_on;
using ::testing::HasSubstr;

const std::string kFlaser = "FLASER 2 1.0 81.83 1 2 0.5 3 4 0.6 7.5 host 0.1\n";
const std::string kRobotLaser =
    "ROBOTLASER1 0 -1.57 3.14 0.0175 80 0.01 0 3 1 2 nan 1 9 1 2 0.5 3 4 0.6 0 0 0.3 0.2 100 8.5 host 0.2\n";

Trajectory laser(std::istream& input) {
  Diagnostics diagnostics;
  return read_carmen_trajectory(input, "f", CarmenPose::kLaser, diagnostics);
}

TEST(CarmenTrajectory, TakesEitherPoseOfEitherMessage) {
  for (const CarmenPose which : {CarmenPose::kLaser, CarmenPose::kRobot}) {
    std::istringstream input("# CARMEN\nPARAM a b\nODOM 9 9 9 0 0 0 1 h 1\n" + kFlaser + kRobotLaser);
    Diagnostics diagnostics;
    const Trajectory poses = read_carmen_trajectory(input, "f", which, diagnostics);
    ASSERT_EQ(poses.size(), 2u);
    const Pose2 expected = which == CarmenPose::kLaser ? Pose2{1, 2, 0.5} : Pose2{3, 4, 0.6};
    EXPECT_EQ(poses[0].pose, expected);
    EXPECT_EQ(poses[1].pose, expected);
    EXPECT_EQ(poses[0].stamp, time_from_seconds(7.5));
    EXPECT_EQ(poses[1].stamp, time_from_seconds(8.5));
  }
}

TEST(CarmenTrajectory, RefusesWhatIsMalformed) {
  EXPECT_THAT(error_on(laser, "FLASER 1000000000 1 2 3\n"), HasSubstr("f:1:8: announces 1000000000"));
  EXPECT_THAT(error_on(laser, "FLASER -1 1 2 3\n"), HasSubstr("announces -1"));
  EXPECT_THAT(error_on(laser, "FLASER 2 1.0 far 1 2 0.5 3 4 0.6 7.5 host 0.1\n"), HasSubstr("'far'"));
  EXPECT_THAT(error_on(laser, "FLASER 1 1.0 1 2 nan 3 4 0.6 7.5 host 0.1\n"),
              HasSubstr("theta is not finite"));
  EXPECT_THAT(error_on(laser, "ODOM 9 9 9 0 0 0 1 h 1\n"), HasSubstr("no pose"));
}

TEST(CarmenTrajectory, NoCutCrashes) { EXPECT_GT(test::accepted_cuts(laser, kFlaser + kRobotLaser), 0u); }

}  // namespace
}  // namespace cairn
