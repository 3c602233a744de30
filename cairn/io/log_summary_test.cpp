#include "cairn/io/log_summary.hpp"

#include "cairn/io/log_reader.hpp"
#include "test_data.hpp"

#include <chrono>
#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace cairn {
namespace {

Time at(double seconds) { return time_from_seconds(seconds); }

Event odometry(double stamp_s, double x) {
  return {at(stamp_s), at(stamp_s), 0, Odometry{at(stamp_s), {x, 0, 0}}};
}

Event scan(double stamp_s, std::vector<float> ranges) {
  return {
      at(stamp_s), at(stamp_s), 1,
      std::make_shared<const LaserScan>(LaserScan{at(stamp_s), -1.0, 0.5, 0.01, 10.0, std::move(ranges)})};
}

Log small_log() {
  Log log;
  log.format = "test";
  log.streams = {{"odom", StreamKind::kOdometry, "", std::nullopt},
                 {"laser", StreamKind::kLaserScan, "laser_link", Pose2{0.5, 0, 0}}};
  // 0, 1, 2, 3, 13: one gap of ten seconds; the message of second 2 comes before that of second 1.
  log.events = {odometry(0, 0),
                odometry(2, 2),
                odometry(1, 1),
                odometry(3, 3),
                odometry(13, 4),
                scan(0.5, {1.0F, NAN, 10.0F, 0.0F}),
                scan(1.5, {1.0F, 2.0F, 3.0F, 4.0F, 5.0F})};
  log.diagnostics.warn("malformed line", "f:3", "bad");
  log.diagnostics.count("malformed line", 4);
  return log;
}

TEST(LogSummary, StreamsRatesAndGaps) {
  const LogSummary summary = summarize(small_log());
  EXPECT_EQ(summary.messages, 7U);
  EXPECT_EQ(summary.last - summary.first, std::chrono::seconds(13));
  const StreamSummary& odom = summary.streams[0];
  EXPECT_EQ(odom.messages, 5U);
  EXPECT_NEAR(odom.rate_hz, 4.0 / 13.0, 1e-12);
  EXPECT_NEAR(odom.median_period_s, 1.0, 1e-12);
  EXPECT_EQ(odom.gaps, 1U);
  EXPECT_NEAR(odom.longest_gap_s, 10.0, 1e-12);
  EXPECT_EQ(odom.time_reversals, 1U);
  ASSERT_TRUE(odom.odometry);
  EXPECT_NEAR(odom.odometry->path_length_m, 2 + 1 + 2 + 1, 1e-12);
  EXPECT_NEAR(odom.odometry->path_length_by_stamp_m, 4.0, 1e-12);
  EXPECT_FALSE(odom.laser);
}

TEST(LogSummary, Lasers) {
  const StreamSummary laser = summarize(small_log()).streams[1];
  ASSERT_TRUE(laser.laser);
  EXPECT_EQ(laser.laser->beams_min, 4U);
  EXPECT_EQ(laser.laser->beams_max, 5U);
  EXPECT_EQ(laser.laser->first_angle_rad, -1.0);
  EXPECT_EQ(laser.laser->last_angle_rad, 0.5);
  EXPECT_NEAR(laser.laser->valid_share, 6.0 / 9.0, 1e-12);
  EXPECT_EQ(laser.gaps, 0U);
}

TEST(LogSummary, NoEventsAndOneEvent) {
  EXPECT_EQ(summarize(Log{}).messages, 0U);
  Log log = small_log();
  log.events.resize(1);
  const LogSummary summary = summarize(log);
  EXPECT_EQ(summary.streams[0].rate_hz, 0.0);
  EXPECT_EQ(summary.streams[1].messages, 0U);
  EXPECT_NO_THROW(nlohmann::json::parse(to_json(summary)));
}

TEST(LogSummary, Json) {
  const auto json = nlohmann::json::parse(to_json(summarize(small_log())));
  EXPECT_EQ(json["format"], "test");
  EXPECT_EQ(json["span_s"], 13.0);
  EXPECT_EQ(json["streams"][0]["kind"], "odometry");
  EXPECT_EQ(json["streams"][0]["gaps"], 1);
  EXPECT_TRUE(json["streams"][0]["T_base_sensor"].is_null());
  EXPECT_EQ(json["streams"][1]["T_base_sensor"]["x_m"], 0.5);
  EXPECT_EQ(json["streams"][1]["frame"], "laser_link");
  EXPECT_EQ(json["streams"][1]["laser"]["beams_max"], 5);
  EXPECT_EQ(json["warnings"][0]["kind"], "malformed line");
  EXPECT_EQ(json["warnings"][0]["count"], 5);
  EXPECT_EQ(json["warnings"][0]["examples"][0], "f:3: bad");
}

TEST(LogSummary, BytesThatAreNoUtf8DoNotBreakJson) {
  Log log = small_log();
  log.streams[1].frame = "\xff\xfe";
  EXPECT_NO_THROW(nlohmann::json::parse(to_json(summarize(log))));
}

// 508 m is the path length that the data set's description tells.
TEST(LogSummaryRecording, IntelPathLength) {
  CAIRN_SKIP_WITHOUT("radish_raw/intel.clf.bz2");
  const LogSummary summary = summarize(read_log(test::data_file("radish_raw/intel.clf.bz2")));
  EXPECT_NEAR(to_seconds(summary.last - summary.first), 2691.0, 1.0);
  ASSERT_EQ(summary.streams[1].info.name, "flaser_odom");
  EXPECT_EQ(summary.streams[1].time_reversals, 631U);
  EXPECT_NEAR(summary.streams[1].odometry->path_length_m, 508.35, 0.01);
  EXPECT_NEAR(summary.streams[1].odometry->path_length_by_stamp_m, 660.9, 0.1)
      << "its stamps are not to be trusted";
}

}  // namespace
}  // namespace cairn
