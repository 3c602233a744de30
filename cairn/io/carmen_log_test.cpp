#include "cairn/io/carmen_log.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/input_file.hpp"
#include "log_inspection.hpp"
#include "test_data.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using test::count;
using test::first_example;
using test::pose_of;
using test::scan_of;
using ::testing::AllOf;
using ::testing::HasSubstr;

Log read(const std::string& text) {
  std::istringstream input(text);
  return read_carmen_log(input, "a.clf");
}

std::string error_of(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string odom(double x, const std::string& stamp) {
  return "ODOM " + std::to_string(x) + " 0 0 0.1 0 0 " + stamp + " nohost 0\n";
}

std::string flaser(std::size_t n, const std::string& range, const std::string& stamp = "1.0") {
  std::string line = "FLASER " + std::to_string(n);
  for (std::size_t i = 0; i < n; ++i) line += " " + range;
  return line + " 9 9 9 1 2 0.5 " + stamp + " nohost 0.1\n";
}

const std::string kSmall =
    "# CARMEN\n"
    "PARAM robot_frontlaser_offset 0.3 nohost 0\n"
    "SYNC tag 0 nohost 0\n"
    "ODOM 1 2 7.0 0.1 0.2 0 976052857.337284 nohost 0.000246\n"
    "FLASER 3 1.5 nan 2.5 9 9 9 1 2 0.5 976052857.437284 nohost 0.1\n";

TEST(CarmenLog, ReadsOdometryAndScans) {
  const Log log = read(kSmall);
  EXPECT_EQ(log.format, "carmen");
  ASSERT_EQ(log.streams.size(), 3U);
  EXPECT_EQ(log.streams[0].name, "odom");
  EXPECT_EQ(log.streams[1].name, "flaser_odom");
  EXPECT_EQ(log.streams[2].name, "flaser");
  EXPECT_EQ(log.streams[1].kind, StreamKind::kOdometry);
  EXPECT_EQ(log.streams[2].kind, StreamKind::kLaserScan);
  EXPECT_EQ(log.streams[2].T_base_sensor, (Pose2{0.3, 0, 0}));
  ASSERT_EQ(log.events.size(), 3U);
  EXPECT_EQ(log.events[0].stamp.time_since_epoch().count(), 976052857337284000);
  EXPECT_NEAR(pose_of(log.events[0]).theta, 7.0 - kTwoPi, 1e-12);
  EXPECT_EQ(pose_of(log.events[1]), (Pose2{1, 2, 0.5}));
  EXPECT_EQ(log.events[1].stamp, log.events[2].stamp);
  const LaserScan& scan = scan_of(log.events[2]);
  EXPECT_EQ(scan.stamp, log.events[2].stamp);
  EXPECT_EQ(scan.ranges_m.size(), 3U);
  EXPECT_TRUE(std::isnan(scan.ranges_m[1]));
  EXPECT_FALSE(scan.is_valid_range(0.0F));
  EXPECT_EQ(scan.range_max_m, 80.0);
  EXPECT_TRUE(log.diagnostics.empty());
}

TEST(CarmenLog, AnglesFollowTheNumberOfBeams) {
  struct Case {
    std::size_t n;
    double start_deg;
    double step_deg;
  };
  for (const Case& c : {Case{180, -90, 1}, Case{181, -90, 1}, Case{360, -90, 0.5}, Case{361, -90, 0.5},
                        Case{401, -50, 0.25}, Case{1, -90, 180}, Case{2, -90, 90}}) {
    const Log log = read(flaser(c.n, "1.0"));
    EXPECT_NEAR(radians_to_degrees(scan_of(log.events[1]).angle_min_rad), c.start_deg, 1e-9) << c.n;
    EXPECT_NEAR(radians_to_degrees(scan_of(log.events[1]).angle_increment_rad), c.step_deg, 1e-9) << c.n;
  }
}

TEST(CarmenLog, RearLaserLooksBack) {
  const Log log = read("PARAM robot_rearlaser_offset -0.2 nohost 0\nRLASER 1 2 0 0 0 0 0 0 1 h 0\n");
  EXPECT_EQ(log.streams[1].name, "rlaser");
  EXPECT_EQ(log.streams[1].T_base_sensor, (Pose2{-0.2, 0, -kPi}));
}

std::string robot_laser(const std::string& laser_pose, const std::string& stamp = "5.0") {
  return "ROBOTLASER1 0 -1.5 3.0 1.5 30.0 0.01 0 3 1 2 31 2 0.5 0.5 " + laser_pose +
         " 1 1 0 0.1 0.2 0.3 0.4 1e6 " + stamp + " host 5.25\n";
}

TEST(CarmenLog, RobotLaserTellsItsSettings) {
  const Log log = read(robot_laser("1.2 1.1 0") + robot_laser("1.2 1.1 0", "6.0"));
  EXPECT_EQ(log.streams[0].name, "robotlaser1_odom");
  EXPECT_EQ(log.streams[1].name, "robotlaser1");
  const LaserScan& scan = scan_of(log.events[1]);
  EXPECT_EQ(scan.angle_min_rad, -1.5);
  EXPECT_EQ(scan.angle_increment_rad, 1.5);
  EXPECT_EQ(scan.range_max_m, 30.0);
  EXPECT_FALSE(scan.is_valid_range(scan.ranges_m[2]));
  EXPECT_EQ(pose_of(log.events[0]), (Pose2{1, 1, 0}));
  ASSERT_TRUE(log.streams[1].T_base_sensor);
  EXPECT_NEAR(log.streams[1].T_base_sensor->x, 0.2, 1e-12);
  EXPECT_NEAR(log.streams[1].T_base_sensor->y, 0.1, 1e-12);
  EXPECT_EQ(log.events[1].arrival - log.events[1].stamp, std::chrono::milliseconds(250));
}

TEST(CarmenLog, LaserPosesThatDoNotAgreeAreNoMount) {
  const Log log = read(robot_laser("1.2 1 0") + robot_laser("1.4 1 0") + robot_laser("1.2 1 0"));
  EXPECT_FALSE(log.streams[1].T_base_sensor);
  EXPECT_EQ(count(log, "mount unknown"), 1);
}

TEST(CarmenLog, RawLaserHasNoOdometry) {
  const Log log = read("RAWLASER2 0 -1.5 3.0 1.5 30.0 0.01 0 3 1 2 31 0 5.0 host 0.1\n");
  ASSERT_EQ(log.streams.size(), 1U);
  EXPECT_EQ(log.streams[0].name, "rawlaser2");
  EXPECT_EQ(log.events[0].arrival, log.events[0].stamp) << "the logger counts from its own start";
}

TEST(CarmenLog, OtherMessagesAreCounted) {
  const Log log = read(odom(0, "1") + "TRUEPOS 1 2 3 4 5 6 7 h 8\nFOO 1\n");
  EXPECT_EQ(count(log, "unsupported message"), 1);
  EXPECT_EQ(count(log, "unknown message"), 1);
  EXPECT_EQ(log.events.size(), 1U);
}

// Each between two good lines: skipped, counted, and named with its line and column.
TEST(CarmenLog, MalformedLinesAreSkippedAndCounted) {
  const struct {
    const char* line;
    const char* says;
  } cases[] = {
      {"ODOM 1 x 0 0 0 0 1 h 0", "a.clf:2:8: 'x' stands where the y belongs"},
      {"ODOM 1 nan 0 0 0 0 1 h 0", "a.clf:2:8: y is not finite"},
      {"ODOM 1 2 inf 0 0 0 1 h 0", "heading is not finite"},
      {"ODOM 1e30 2 0 0 0 0 1 h 0", "farther than 10,000 km"},
      {"ODOM 1 2 0 0 0 0 nan h 0", "ipc timestamp"},
      {"ODOM 1 2 0 0 0 0 1e12 h 0", "292 years"},
      {"ODOM 1 2 0 0 0 0 1 h", "logger timestamp"},
      {"ODOM 1 2 0 0 0 0 1 h 0 77", "a.clf:2:24: more fields"},
      {"FLASER 1000000000 1 2 3 0 0 0 0 0 0 1 h 0", "where the range belongs"},
      {"FLASER -5 1 2 3 0 0 0 0 0 0 1 h 0", "a.clf:2:8: number of readings is -5"},
      {"FLASER 0 0 0 0 0 0 0 1 h 0", "number of readings is 0"},
      {"FLASER 2 1 -2 0 0 0 0 0 0 1 h 0", "negative range"},
      {"FLASER 2 1 -inf 0 0 0 0 0 0 1 h 0", "negative range"},
      {"FLASER 2 1 2 3 0 0 0 0 0 0 1 h 0", "stands where the logger timestamp belongs"},
      {"FLASER 2.5 1 2 3 0 0 0 0 0 0 1 h 0", "whole number"},
      {"ROBOTLASER1 0 0 0 1e9 30 0 0 1 1 0 0 0 0 0 0 0 0 0 0 0 0 1 h 0", "go round more than twice"},
      {"ROBOTLASER1 0 0 0 1 -3 0 0 1 1 0 0 0 0 0 0 0 0 0 0 0 0 1 h 0", "maximum range"},
      {"ROBOTLASER1 0 0 0 1 30 0 0 1 1 1000000000 0 0 0 0 0 0 0 0 0 0 0 1 h 0", "remission"},
      {"ROBOTLASER1 0 0 0 1 30 0 0 1 1 -1 0 0 0 0 0 0 0 0 0 0 0 1 h 0", "number of readings is -1"},
      {"PARAM robot_frontlaser_offset far h 0", "'far'"},
      {"PARAM", "parameter name"},
      {"0.1 0.2 0.3", "does not start with a message name"},
      {"odom 1 2 3", "does not start with a message name"},
  };
  for (const auto& c : cases) {
    const Log log = read(odom(0, "1") + c.line + "\n" + odom(0, "2"));
    EXPECT_EQ(log.events.size(), 2U) << c.line;
    EXPECT_EQ(log.streams.size(), 1U) << c.line;
    EXPECT_EQ(count(log, "malformed line"), 1) << c.line;
    EXPECT_THAT(first_example(log), AllOf(HasSubstr("a.clf:2:"), HasSubstr(c.says))) << c.line;
  }
}

TEST(CarmenLog, NothingUsableOrMostlyMalformedIsAnError) {
  EXPECT_THAT(error_of(""), HasSubstr("a.clf: no usable message in 0 lines"));
  EXPECT_THAT(error_of("# only a comment\n\n"), HasSubstr("no usable message"));
  EXPECT_THAT(error_of("PARAM robot_use_laser on nohost 0\n"), HasSubstr("no usable message"));
  EXPECT_THAT(error_of("x\n" + odom(0, "1") + "y\n"),
              AllOf(HasSubstr("2 of 3 lines are malformed"), HasSubstr("a.clf:1:1")));
  EXPECT_EQ(error_of("x\n" + odom(0, "1")), "no error");
}

// A stamp repeated or run back must not look like speed, nor must a burst of messages (as in intel).
TEST(CarmenLog, BurstsOfStampsAreNotTakenForWrongUnits) {
  std::string text;
  for (int i = 0; i < 400; ++i) text += odom(0.03 * i, std::to_string(0.5 * (i / 10) + 0.0001 * (i % 7)));
  EXPECT_EQ(count(read(text), "implausible units"), 0);
}

TEST(CarmenLog, LargeFileThatIsNoLogEndsEarly) {
  std::string text;
  for (int i = 0; i < 30000; ++i) text += "x\n";
  EXPECT_THAT(error_of(text), HasSubstr("10000 of 10000 lines"));
}

TEST(CarmenLog, StampsThatRunBackwardsAreCountedAndKept) {
  const Log log = read(odom(0, "2.0") + odom(1, "1.0") + odom(2, "3.0"));
  EXPECT_EQ(log.events.size(), 3U);
  EXPECT_EQ(count(log, "time reversal"), 1);
  EXPECT_THAT(first_example(log), HasSubstr("a.clf:2: stamp 1.000000000 is 1.000000 s earlier"));
}

TEST(CarmenLog, CentimetresAreNoticed) {
  EXPECT_EQ(count(read(flaser(180, "250")), "implausible units"), 1);
  EXPECT_EQ(count(read(flaser(180, "2.5")), "implausible units"), 0);
  std::string metres;
  std::string centimetres;
  for (int i = 0; i < 20; ++i) {
    metres += odom(0.5 * i, std::to_string(i));
    centimetres += odom(50.0 * i, std::to_string(i));
  }
  EXPECT_EQ(count(read(metres), "implausible units"), 0);
  EXPECT_EQ(count(read(centimetres), "implausible units"), 1);
}

TEST(CarmenLog, MarkForNoReturnIsFoundInTheReadings) {
  std::string text;
  for (int i = 0; i < 10; ++i) text += flaser(180, std::to_string(1.0 + i), std::to_string(i));
  for (int i = 0; i < 10; ++i) text += flaser(20, "50.00", std::to_string(20 + i));
  const Log log = read(text);
  EXPECT_NEAR(scan_of(log.events[1]).range_max_m, 49.9, 1e-3);
  EXPECT_EQ(count(log, "range limit inferred"), 1);
}

struct Expected {
  const char* file;
  std::size_t odom;
  std::size_t scans;
  std::size_t beams;
  double span_s;
  double range_max_m;
};

class CarmenRecording : public ::testing::TestWithParam<Expected> {};

TEST_P(CarmenRecording, IsReadWhole) {
  const Expected& expected = GetParam();
  CAIRN_SKIP_WITHOUT(expected.file);
  const auto input = open_input(test::data_file(expected.file));
  Log log = read_carmen_log(*input, expected.file);
  auto by_name = test::messages_by_stream(log);
  EXPECT_EQ(by_name["odom"], expected.odom);
  EXPECT_EQ(by_name["flaser"], expected.scans);
  EXPECT_EQ(by_name["flaser_odom"], expected.scans);
  EXPECT_EQ(count(log, "malformed line"), 0);
  EXPECT_EQ(count(log, "implausible units"), 0);
  for (const Event& event : log.events) {
    if (!test::is_scan(event)) continue;
    ASSERT_EQ(scan_of(event).ranges_m.size(), expected.beams);
    ASSERT_NEAR(scan_of(event).range_max_m, expected.range_max_m, 1e-3);
  }
  sort_by_stamp(log);
  EXPECT_NEAR(to_seconds(log.events.back().stamp - log.events.front().stamp), expected.span_s, 1.0);
}

INSTANTIATE_TEST_SUITE_P(
    Radish, CarmenRecording,
    ::testing::Values(Expected{"radish_raw/intel.clf.bz2", 26915, 13631, 180, 2691, 80.0},
                      Expected{"radish_raw/aces.clf.bz2", 7375, 7374, 180, 1366, 49.9},
                      Expected{"radish_derived/edmonton.log.gz", 0, 340, 180, 707.98, 51.06},
                      Expected{"radish_derived/seattle.log.gz", 0, 241, 361, 1165.33, 80.0},
                      Expected{"radish_derived/freiburg-101.log.gz", 0, 292, 360, 918.94, 80.0}),
    [](const auto& test) {
      const std::string file = test.param.file;
      const auto start = file.find('/') + 1;
      std::string name = file.substr(start, file.find('.') - start);
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

}  // namespace
}  // namespace cairn
