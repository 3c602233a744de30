#include "cairn/io/mrpt_text_log.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/input_file.hpp"
#include "log_inspection.hpp"
#include "test_data.hpp"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using test::count;
using test::pose_of;
using test::scan_of;
using ::testing::HasSubstr;

Log read(const std::string& text) {
  std::istringstream input(text);
  return read_mrpt_text_log(input, "m.txt");
}

std::string laser(const std::string& stamp) {
  return "LASER " + stamp + " 3 80 3.0 0.1 -0.2 0.3 1.5 80.00 0.0\n";
}

TEST(MrptTextLog, OdometryOfAFrameIsTheMotionToTheNext) {
  const Log log = read("FRAME 0\nODO 1 0 1.5707963267948966\n" + laser("10.5") + "FRAME 1\nODO 1 0 0\n" +
                       laser("11") + "FRAME 2\n" + laser("12"));
  ASSERT_EQ(log.events.size(), 6U);
  EXPECT_EQ(pose_of(log.events[0]), Pose2{});
  EXPECT_NEAR(pose_of(log.events[2]).x, 1.0, 1e-12);
  EXPECT_NEAR(pose_of(log.events[4]).x, 1.0, 1e-12);
  EXPECT_NEAR(pose_of(log.events[4]).y, 1.0, 1e-12);
  EXPECT_EQ(log.events[0].stamp, scan_of(log.events[1]).stamp);
}

TEST(MrptTextLog, AFrameWithoutLaserKeepsItsMotion) {
  const Log log = read("FRAME 0\nODO 1 0 0\n" + laser("10") + "FRAME 1\nODO 2 0 0\nFRAME 2\n" + laser("12"));
  EXPECT_EQ(pose_of(log.events[2]), (Pose2{3, 0, 0}));
}

TEST(MrptTextLog, ScanAndMount) {
  const Log log = read("FRAME 0\nBEACON 1 5.5\n" + laser("10"));
  ASSERT_EQ(log.streams.size(), 3U);
  EXPECT_EQ(log.streams[1].T_base_sensor, (Pose2{0.1, -0.2, 0}));
  const LaserScan& scan = scan_of(log.events[1]);
  EXPECT_EQ(scan.angle_min_rad, -1.5);
  EXPECT_EQ(scan.angle_increment_rad, 1.5);
  EXPECT_TRUE(scan.is_valid_range(scan.ranges_m[0]));
  EXPECT_FALSE(scan.is_valid_range(scan.ranges_m[1]));
  EXPECT_FALSE(scan.is_valid_range(scan.ranges_m[2]));
  EXPECT_EQ(count(log, "malformed line"), 0);
}

TEST(MrptTextLog, BeaconsBelongToTheScanOfTheirFrame) {
  const Log log = read("FRAME 0\nBEACON 1 5.5\nBEACON 2 0\nBEACON 3 7.25\n" + laser("10") +
                       "FRAME 1\nBEACON 1 4\nFRAME 2\nBEACON 2 -1\n" + laser("12"));
  ASSERT_EQ(log.streams.size(), 3U);
  EXPECT_EQ(log.streams[2].kind, StreamKind::kBeaconRanges);
  ASSERT_EQ(log.events.size(), 5U) << "frame 1 has no stamp, frame 2 no reading";
  const auto& ranges = *std::get<std::shared_ptr<const BeaconRanges>>(log.events[2].payload);
  EXPECT_EQ(ranges.stamp, log.events[1].stamp);
  ASSERT_EQ(ranges.readings.size(), 2U) << "a range of zero is none";
  EXPECT_EQ(ranges.readings[1].id, "3");
  EXPECT_EQ(ranges.readings[1].range_m, 7.25);
  EXPECT_EQ(count(log, "beacon without stamp"), 1);
  EXPECT_EQ(count(log, "malformed line"), 1);
}

TEST(MrptTextLog, BeaconsThatCannotBeKeptAreCounted) {
  const Log log = read("FRAME 0\nBEACON 1 5\nBEACON 1 6\n" + laser("10") + "FRAME 1\nBEACON 1 4\n");
  const auto& ranges = *std::get<std::shared_ptr<const BeaconRanges>>(log.events[2].payload);
  ASSERT_EQ(ranges.readings.size(), 1U);
  EXPECT_EQ(ranges.readings[0].range_m, 5.0);
  EXPECT_EQ(count(log, "beacon told twice"), 1);
  EXPECT_EQ(count(log, "beacon without stamp"), 1) << "the last frame has no laser";
}

TEST(MrptTextLog, MalformedLines) {
  const std::string good = "FRAME 0\nODO 0 0 0\n" + laser("10");
  const struct {
    const char* line;
    const char* says;
  } cases[] = {
      {"LASER 11 1000000000 80 3 0 0 0 1 2", "where the range belongs"},
      {"LASER 11 -3 80 3 0 0 0 1 2", "m.txt:4:10: number of beams is -3"},
      {"LASER 11 1 80 3 0 0 0 1", "number of beams is 1"},
      {"LASER 11 2 80 180 0 0 0 1 2", "aperture"},
      {"LASER 11 2 0 3 0 0 0 1 2", "maximum range"},
      {"LASER 11 2 80 3 0 0 0 1 -2", "negative range"},
      {"LASER 11 2 80 3 0 0 0 1 2 3", "more fields"},
      {"ODO 0 0 x", "'x'"},
      {"ODO 0 0 0 0", "more fields"},
      {"FRAME one", "'one'"},
      {"BEACON 1 far", "'far'"},
      {"GPS 1 2", "none of FRAME, ODO, LASER, BEACON"},
  };
  for (const auto& c : cases) {
    const Log log = read(good + c.line + "\n");
    EXPECT_EQ(log.events.size(), 2U) << c.line;
    EXPECT_EQ(count(log, "malformed line"), 1) << c.line;
    EXPECT_THAT(test::first_example(log), HasSubstr(c.says)) << c.line;
  }
}

TEST(MrptRecording, IsReadWhole) {
  CAIRN_SKIP_WITHOUT("mrpt_uwb_laser/log.txt");
  const auto path = test::data_file("mrpt_uwb_laser/log.txt");
  const Log log = read_mrpt_text_log(*open_input(path), path.string());
  auto counts = test::messages_by_stream(log);
  EXPECT_EQ(counts["odom"], 343U);
  EXPECT_EQ(counts["laser"], 343U);
  EXPECT_EQ(counts["uwb"],
            337U);  // frames with a range: 1017 BEACON lines in all, 1011 of beacons that answered
  EXPECT_TRUE(log.diagnostics.counts().empty());
  EXPECT_EQ(log.streams[1].T_base_sensor, (Pose2{0.095, 0, 0}));
  EXPECT_NEAR(to_seconds(log.events.back().stamp - log.events.front().stamp), 363.0, 1.0);
}

}  // namespace
}  // namespace cairn
