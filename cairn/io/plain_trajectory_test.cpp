#include "cairn/io/plain_trajectory.hpp"

#include "bad_input.hpp"

#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using test::error_on;
using ::testing::HasSubstr;

const std::vector<Time> kFrames = {time_from_seconds(10), time_from_seconds(11), time_from_seconds(12)};

Trajectory plain(std::istream& input) {
  Diagnostics diagnostics;
  return read_plain_trajectory(input, "f", diagnostics);
}
Trajectory rawseeds(std::istream& input) {
  Diagnostics diagnostics;
  return read_rawseeds_trajectory(input, "f", diagnostics);
}
Trajectory indexed(std::istream& input) {
  Diagnostics diagnostics;
  return read_indexed_trajectory(input, "f", kFrames, 1, diagnostics);
}

TEST(PlainTrajectory, ReadsItsFourFields) {
  std::istringstream input("# comment\n976052857.337530 -0.09524 1 4.0\n");
  const Trajectory poses = plain(input);
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_EQ(format_time(poses[0].stamp), "976052857.337530000");
  EXPECT_EQ(poses[0].pose.x, -0.09524);
  EXPECT_NEAR(poses[0].pose.theta, 4.0 - 2 * 3.14159265358979, 1e-12);
}

TEST(PlainTrajectory, RefusesWhatIsMalformed) {
  EXPECT_THAT(error_on(plain, "1 2 3 4\n1 2 3\n"), HasSubstr("f:2:"));
  EXPECT_THAT(error_on(plain, "1 2 3 4 5\n"), HasSubstr("f:1:9"));
  EXPECT_THAT(error_on(plain, "1 2 three 4\n"), HasSubstr("f:1:5: 'three'"));
  EXPECT_THAT(error_on(plain, "1 2 3 inf\n"), HasSubstr("theta is not finite"));
  EXPECT_THAT(error_on(plain, "# nothing\n"), HasSubstr("no pose"));
}

TEST(RawseedsTrajectory, ReadsWithAndWithoutCovariance) {
  std::istringstream input("1.5, 2, 3, 0.5\n2.5,-0.3,-6.3,1.39,1,0,0,0,1,0,0,0,1\r\n");
  const Trajectory poses = rawseeds(input);
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[0].pose, (Pose2{2, 3, 0.5}));
  EXPECT_EQ(poses[1].pose, (Pose2{-0.3, -6.3, 1.39}));
}

TEST(RawseedsTrajectory, RefusesWhatIsMalformed) {
  EXPECT_THAT(error_on(rawseeds, "1,2,,4\n"), HasSubstr("empty field where the y belongs"));
  EXPECT_THAT(error_on(rawseeds, "1,2,3,4,5\n"), HasSubstr("covariance"));
  EXPECT_THAT(error_on(rawseeds, "1,2,3,4,1,0,0,0,1,0,0,0,1,1\n"), HasSubstr("too many"));
  EXPECT_THAT(error_on(rawseeds, "t,x,y,theta\n"), HasSubstr("f:1:1"));
}

TEST(IndexedTrajectory, TakesTheStampsOfTheFramesAfterTheOffset) {
  std::istringstream input("0 1 2 3\n1 4 5 6\n");
  const Trajectory poses = indexed(input);
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[0].stamp, kFrames[1]);
  EXPECT_EQ(poses[1].stamp, kFrames[2]);
  EXPECT_EQ(poses[1].pose.x, 4.0);
}

TEST(IndexedTrajectory, RefusesNumbersOutsideTheLog) {
  EXPECT_THAT(error_on(indexed, "0 1 2 3\n1 1 2 3\n2 1 2 3\n"),
              HasSubstr("f:3:1: pose 2 belongs to no frame"));
  EXPECT_THAT(error_on(indexed, "-2 1 2 3\n"), HasSubstr("belongs to no frame"));
  EXPECT_THAT(error_on(indexed, "9223372036854775807 1 2 3\n"), HasSubstr("belongs to no frame"));
  EXPECT_THAT(error_on(indexed, "0.5 1 2 3\n"), HasSubstr("f:1:1"));
}

TEST(IndexedTrajectory, IsToldByItsWholeNumbers) {
  const auto is_indexed = [](const std::string& text) {
    std::istringstream input(text);
    return is_indexed_trajectory(input);
  };
  EXPECT_TRUE(is_indexed("# c\n0 1 2 3\n1 1 2 3\n"));
  EXPECT_FALSE(is_indexed("0.0 1 2 3\n1.0 1 2 3\n"));
  EXPECT_FALSE(is_indexed("0 1 2 3\n2 1 2 3\n"));
  EXPECT_FALSE(is_indexed(""));
}

TEST(PlainTrajectory, NoCutCrashesAnyReader) {
  EXPECT_GT(test::accepted_cuts(plain, "1.5 2.5 3.5 0.25\n2.5 2.5 3.5 0.25\n"), 0u);
  EXPECT_GT(test::accepted_cuts(rawseeds, "1.5,2.5,3.5,0.25,1,0,0,0,1,0,0,0,1\n"), 0u);
  EXPECT_GT(test::accepted_cuts(indexed, "0 2.5 3.5 0.25\n1 2.5 3.5 0.25\n"), 0u);
}

}  // namespace
}  // namespace cairn
