#include "cairn/io/wean_log.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/input_file.hpp"
#include "log_inspection.hpp"
#include "test_data.hpp"

#include <numbers>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using test::count;
using test::pose_of;
using test::scan_of;
using ::testing::HasSubstr;

std::string laser_line(const std::string& poses, int beams, const std::string& stamp) {
  std::ostringstream line;
  line << "L " << poses;
  for (int i = 0; i < beams; ++i) line << ' ' << 100 + i;
  line << ' ' << stamp << '\n';
  return line.str();
}

const std::string kPoses = "100 200 0.5 100 225 0.5";

Log read(const std::string& text) {
  std::istringstream input(text);
  return read_wean_log(input, "w.log");
}

TEST(WeanLog, CentimetresBecomeMetres) {
  const Log log = read("O 100.5 -200 0.5 0.026001\n" + laser_line("100 200 0 125 200 0", 180, "0.25"));
  EXPECT_EQ(log.format, "wean");
  ASSERT_EQ(log.events.size(), 3U);
  EXPECT_EQ(log.streams[0].name, "odom");
  EXPECT_EQ(log.streams[1].name, "laser_odom");
  EXPECT_EQ(log.streams[2].name, "laser");
  EXPECT_EQ(log.events[0].stamp.time_since_epoch().count(), 26001000);
  EXPECT_NEAR(pose_of(log.events[0]).x, 1.005, 1e-12);
  EXPECT_NEAR(pose_of(log.events[0]).y, -2.0, 1e-12);
  const LaserScan& scan = scan_of(log.events[2]);
  EXPECT_FLOAT_EQ(scan.ranges_m[0], 1.0F);
  EXPECT_FLOAT_EQ(scan.ranges_m[179], 2.79F);
  EXPECT_NEAR(scan.angle_min_rad, -std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(scan.angle_increment_rad, std::numbers::pi / 180, 1e-12);
  ASSERT_TRUE(log.streams[2].T_base_sensor);
  EXPECT_NEAR(log.streams[2].T_base_sensor->x, 0.25, 1e-12);
}

TEST(WeanLog, WrongNumberOfBeamsIsMalformed) {
  const std::string good = laser_line(kPoses, 180, "1.0");
  for (const int beams : {0, 179, 181}) {
    const Log log = read(good + laser_line(kPoses, beams, "1.0"));
    EXPECT_EQ(count(log, "malformed line"), 1) << beams;
    EXPECT_EQ(log.events.size(), 2U);
  }
}

TEST(WeanTrajectory, HoldsThePosesOfAllLinesInOrder) {
  std::istringstream input(laser_line(kPoses, 180, "2.0") + "O 300 0 0 1.0\n");
  const Trajectory trajectory = read_wean_trajectory(input, "w.log");
  ASSERT_EQ(trajectory.size(), 2U);
  EXPECT_EQ(trajectory[0].pose, (Pose2{3, 0, 0}));
  EXPECT_EQ(trajectory[1].pose, (Pose2{1, 2, 0.5}));
}

TEST(WeanTrajectory, MustBeWhole) {
  for (const char* text : {"", "O 1 2 0 1\nX 1\n", "O 1 2 0 1\nO 1 2\n", "O 1 2 0 1\nO 1 2 nan 2\n",
                           "O 1 2 0 1 5\n", "L 1 2 3 4 5 6 7\n"}) {
    std::istringstream input(text);
    EXPECT_THROW(read_wean_trajectory(input, "w.log"), InputError) << text;
  }
}

struct Expected {
  const char* file;
  std::size_t odometry;
  std::size_t scans;
};

class WeanRecording : public ::testing::TestWithParam<Expected> {};

TEST_P(WeanRecording, IsReadWhole) {
  CAIRN_SKIP_WITHOUT(GetParam().file);
  const auto input = open_input(test::data_file(GetParam().file));
  const Log log = read_wean_log(*input, GetParam().file);
  auto counts = test::messages_by_stream(log);
  EXPECT_EQ(counts["odom"], GetParam().odometry);
  EXPECT_EQ(counts["laser"], GetParam().scans);
  EXPECT_EQ(counts["laser_odom"], GetParam().scans);
  EXPECT_TRUE(log.diagnostics.counts().size() <= 1U) << test::first_example(log);
  EXPECT_EQ(count(log, "malformed line"), 0);
  EXPECT_EQ(count(log, "implausible units"), 0);
  for (const StreamInfo& stream : log.streams) {
    if (stream.name != "laser") continue;
    ASSERT_TRUE(stream.T_base_sensor);
    EXPECT_NEAR(stream.T_base_sensor->x, 0.25, 0.001);
    EXPECT_NEAR(stream.T_base_sensor->y, 0.0, 0.001);
  }
}

INSTANTIATE_TEST_SUITE_P(Logs, WeanRecording,
                         ::testing::Values(Expected{"wean/robotdata1.log", 1505, 713},
                                           Expected{"wean/robotdata2.log", 3126, 2251},
                                           Expected{"wean/robotdata3.log", 1735, 1241}),
                         [](const auto& test) { return "log" + std::string(1, test.param.file[14]); });

TEST(WeanRecording, ReferenceOfLog1) {
  CAIRN_SKIP_WITHOUT("wean/robotdata101.log");
  const auto path = test::data_file("wean/robotdata101.log");
  const Trajectory reference = read_wean_trajectory(*open_input(path), path.string());
  EXPECT_NEAR(reference.front().pose.x, 40.592771429, 1e-9);
  EXPECT_NEAR(to_seconds(reference.back().stamp), 134.998, 0.001);
  EXPECT_GT(reference.size(), 1404U);
  // Its L lines hold the laser's pose in the odometry frame but the robot's in the map: no mount can be told.
  const Log log = read_wean_log(*open_input(path), path.string());
  EXPECT_EQ(count(log, "mount unknown"), 1);
}

}  // namespace
}  // namespace cairn
