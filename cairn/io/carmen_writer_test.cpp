#include "cairn/io/carmen_writer.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/carmen_log.hpp"

#include <cmath>
#include <limits>
#include <sstream>

#include <gtest/gtest.h>

namespace cairn {
namespace {

const Pose2 kMount{0.2, 0.0, 0.0};

Event odometry(double seconds, const Pose2& pose) {
  const Time stamp = time_from_seconds(seconds);
  return {stamp, stamp, 0, Odometry{stamp, pose}};
}

Event scan(double seconds, std::vector<float> ranges, StreamId stream = 1) {
  const Time stamp = time_from_seconds(seconds);
  return {stamp, stamp + std::chrono::milliseconds(3), stream,
          std::make_shared<const LaserScan>(
              LaserScan{stamp, -1.2345678, 0.0174532925, 0.05, 20.0, std::move(ranges)})};
}

Log small_log() {
  return {"",
          {{"odom", StreamKind::kOdometry, "", {}}, {"laser", StreamKind::kLaserScan, "", kMount}},
          {odometry(100.0, {1.0, 2.0, 3.0}), scan(100.05, {1.2345F, 20.0F, 0.5F}),
           odometry(100.1, {1.1, 2.0, -3.1}), scan(100.1, {2.0F, 3.0F, 19.999F})},
          {}};
}

Log through_text(const Log& log) {
  std::stringstream text;
  write_carmen_log(text, log);
  return read_carmen_log(text, "written.log");
}

std::vector<const Event*> of(const Log& log, const std::string& name) {
  std::vector<const Event*> events;
  for (const Event& event : log.events) {
    if (log.streams[event.stream].name == name) events.push_back(&event);
  }
  return events;
}

const LaserScan& scan_of(const Event& event) {
  return *std::get<std::shared_ptr<const LaserScan>>(event.payload);
}

TEST(CarmenWriter, OdometryComesBackToPrintedPrecision) {
  const Log log = small_log();
  const Log back = through_text(log);
  EXPECT_TRUE(back.diagnostics.empty());
  const auto events = of(back, "odom");
  ASSERT_EQ(events.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const Pose2 written = std::get<Odometry>(log.events[2 * i].payload).T_odom_base;
    const Pose2 read = std::get<Odometry>(events[i]->payload).T_odom_base;
    EXPECT_EQ(events[i]->stamp, log.events[2 * i].stamp);
    EXPECT_NEAR(read.x, written.x, 1e-6);
    EXPECT_NEAR(read.y, written.y, 1e-6);
    EXPECT_NEAR(read.theta, written.theta, 1e-6);
  }
}

TEST(CarmenWriter, ScansComeBackToPrintedPrecision) {
  const Log log = small_log();
  const Log back = through_text(log);
  const auto events = of(back, "robotlaser1");
  ASSERT_EQ(events.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const Event& event = log.events[2 * i + 1];
    EXPECT_EQ(events[i]->stamp, event.stamp);
    EXPECT_EQ(events[i]->arrival, event.arrival);
    const LaserScan& written = scan_of(event);
    const LaserScan& read = scan_of(*events[i]);
    EXPECT_NEAR(read.angle_min_rad, written.angle_min_rad, 1e-9);
    EXPECT_NEAR(read.angle_increment_rad, written.angle_increment_rad, 1e-9);
    EXPECT_EQ(read.range_max_m, written.range_max_m);
    ASSERT_EQ(read.ranges_m.size(), written.ranges_m.size());
    for (std::size_t k = 0; k < read.ranges_m.size(); ++k) {
      EXPECT_NEAR(read.ranges_m[k], written.ranges_m[k], 0.00051);
      EXPECT_EQ(read.is_valid_range(read.ranges_m[k]), written.is_valid_range(written.ranges_m[k]));
    }
  }
}

TEST(CarmenWriter, MountAndInterpolatedRobotPoseComeBack) {
  const Log back = through_text(small_log());
  for (const StreamInfo& stream : back.streams) {
    if (stream.kind != StreamKind::kLaserScan) continue;
    ASSERT_TRUE(stream.T_base_sensor.has_value());
    EXPECT_LT(distance(*stream.T_base_sensor, kMount), 1e-5);
  }
  const auto poses = of(back, "robotlaser1_odom");
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_NEAR(std::get<Odometry>(poses[0]->payload).T_odom_base.x, 1.05,
              1e-6);  // half way between the messages
}

TEST(CarmenWriter, LasersWithoutMountAreWrittenRaw) {
  Log log = small_log();
  log.streams.push_back({"second", StreamKind::kLaserScan, "", {}});
  log.events.push_back(scan(100.2, {1.0F}, 2));
  const Log back = through_text(log);
  ASSERT_EQ(of(back, "rawlaser2").size(), 1U);
}

TEST(CarmenWriter, RangesThatAreNotFiniteAreNoReturn) {
  Log log = small_log();
  const float infinity = std::numeric_limits<float>::infinity();
  log.events.push_back(scan(100.2, {std::nanf(""), infinity, 1.0F}));
  const Log back = through_text(log);
  const auto events = of(back, "robotlaser1");
  EXPECT_EQ(scan_of(*events.back()).ranges_m, (std::vector<float>{20.0F, 20.0F, 1.0F}));
}

TEST(CarmenWriter, RefusesLogsThatTheFormatCannotHold) {
  std::ostringstream text;
  Log log = small_log();
  log.streams.push_back({"odom2", StreamKind::kOdometry, "", {}});
  EXPECT_THROW(write_carmen_log(text, log), InputError);
  log = small_log();
  log.events.front().stream = 1;
  EXPECT_THROW(write_carmen_log(text, log), InputError);
  log.events.front().stream = 7;
  EXPECT_THROW(write_carmen_log(text, log), InputError);
  log = small_log();
  log.events.clear();
  EXPECT_THROW(write_carmen_log(text, log), InputError);
  EXPECT_THROW(write_carmen_log("/nowhere/at/all.log", small_log()), InputError);
}

}  // namespace
}  // namespace cairn
