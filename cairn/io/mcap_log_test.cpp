#include "cairn/io/mcap_log.hpp"

#include "bad_input.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/chunk_compression.hpp"
#include "cairn/io/exact_messages.hpp"
#include "cairn/io/log_reader.hpp"
#include "cairn/io/mcap_log_writer.hpp"
#include "cairn/io/mcap_reader.hpp"
#include "cairn/io/ros2_log.hpp"
#include "cairn/io/ros2_messages.hpp"
#include "cairn/io/ros2_schemas.hpp"
#include "log_inspection.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using test::count;

Log read(const std::string& bytes) {
  std::istringstream input(bytes);
  return read_mcap_log(input, "a.mcap");
}

std::string written(const Log& log, mcap::Compression compression = mcap::Compression::kLz4) {
  std::ostringstream output;
  write_mcap_log(output, log, compression);
  return output.str();
}

// Numbers that neither a float nor a quaternion gives back.
Log awkward_log() {
  Log log;
  log.streams = {{"odom", StreamKind::kOdometry, "", {}},
                 {"/front scan", StreamKind::kLaserScan, "laser", Pose2{0.1, -1.0 / 3.0, 2.9999999999999996}},
                 {"tf:odom->base", StreamKind::kOdometry, "odom", {}},
                 {"silent", StreamKind::kLaserScan, "", {}}};
  const float nan = std::bit_cast<float>(0x7fc12345U);
  for (int i = 0; i < 20; ++i) {
    const Time stamp(Duration(1'234'567'890 * std::int64_t{i} - 1));
    const Time arrival = stamp + Duration(7);
    const Pose2 pose{0.1 * i, -1e-17 * i, 3.141592653589793 - 0.3 * i};
    log.events.push_back(
        {stamp, arrival, static_cast<StreamId>(2 * (i % 2)), Odometry{stamp + Duration(1), pose}});
    const std::vector<float> ranges{0.1F * static_cast<float>(i), nan, std::numeric_limits<float>::infinity(),
                                    -0.0F};
    LaserScan scan{stamp, -1.0 / 3.0, 0.1, 0.05, 29.999999999999996, ranges};
    log.events.push_back({stamp, arrival, 1, std::make_shared<const LaserScan>(std::move(scan))});
  }
  return log;
}

void expect_same(const Event& a, const Event& b) {
  EXPECT_EQ(a.stamp, b.stamp);
  EXPECT_EQ(a.arrival, b.arrival);
  EXPECT_EQ(a.stream, b.stream);
  EXPECT_EQ(exact::encode(a), exact::encode(b));
}

TEST(McapLog, ALogComesBackToTheLastBit) {
  for (const auto compression :
       {mcap::Compression::kNone, mcap::Compression::kLz4, mcap::Compression::kZstd}) {
    const Log sent = awkward_log();
    const Log got = read(written(sent, compression));
    EXPECT_EQ(got.format, "cairn_mcap");
    EXPECT_TRUE(got.diagnostics.empty());
    ASSERT_EQ(got.streams.size(), sent.streams.size());
    for (std::size_t i = 0; i < sent.streams.size(); ++i) {
      EXPECT_EQ(got.streams[i].name, sent.streams[i].name);
      EXPECT_EQ(got.streams[i].kind, sent.streams[i].kind);
      EXPECT_EQ(got.streams[i].frame, sent.streams[i].frame);
      EXPECT_EQ(got.streams[i].T_base_sensor, sent.streams[i].T_base_sensor);
    }
    ASSERT_EQ(got.events.size(), sent.events.size());
    for (std::size_t i = 0; i < sent.events.size(); ++i) expect_same(got.events[i], sent.events[i]);
  }
}

// What other tools see: the repetitions in ROS 2's words, read by the reader for ROS 2 bags.
TEST(McapLog, OtherToolsSeeTheSameInRos2) {
  const Log sent = awkward_log();
  ros2::Ros2Log ros("a");
  std::vector<std::string> topics;
  mcap::Handlers handlers;
  handlers.on_channel = [&](const mcap::Schema& schema, const mcap::Channel& channel) {
    topics.push_back(channel.topic);
    EXPECT_EQ(channel.message_encoding, "cdr");
    EXPECT_EQ(schema.encoding, "ros2msg");
  };
  handlers.on_message = [&](const mcap::MessageView& m) {
    ros.add({m.schema.name, m.channel.topic, mcap::from_mcap(m.message.log_time), m.message.data, 0}, "cdr");
  };
  std::istringstream input(written(sent));
  Diagnostics diagnostics;
  EXPECT_EQ(mcap::read(input, "a", handlers, diagnostics).profile, "ros2");
  EXPECT_THAT(topics, testing::IsSupersetOf(
                          {"/odom", "/front_scan", "/tf_odom__base", "/tf", "/tf_static", "/silent"}));
  const Log got = std::move(ros).finish();
  const auto counts = test::messages_by_stream(got);
  EXPECT_EQ(counts.at("/odom"), 10U);
  EXPECT_EQ(counts.at("/front_scan"), 20U);
  EXPECT_EQ(counts.at("tf:odom->base_link"), 10U);
  const auto laser = std::find_if(got.streams.begin(), got.streams.end(),
                                  [](const StreamInfo& info) { return info.name == "/front_scan"; });
  ASSERT_TRUE(laser->T_base_sensor.has_value());
  EXPECT_NEAR(laser->T_base_sensor->y, -1.0 / 3.0, 1e-15);
  EXPECT_EQ(test::scan_of(got.events[2]).ranges_m.size(), 4U);
}

TEST(McapLog, CutAtEveryByteGivesAPrefixAndSaysSo) {
  Log sent = awkward_log();
  sent.events.resize(6);
  const std::string whole = written(sent);
  std::size_t most = 0;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    std::istringstream input(whole.substr(0, size));
    try {
      const Log got = read_mcap_log(input, "a");
      ASSERT_LE(got.events.size(), sent.events.size());
      for (std::size_t i = 0; i < got.events.size(); ++i) expect_same(got.events[i], sent.events[i]);
      EXPECT_EQ(count(got, "truncated") + count(got, "unfinished"), 1) << size;
      EXPECT_GE(got.events.size(), most);
      most = got.events.size();
    } catch (const InputError& error) {
      EXPECT_LT(size, 100U) << error.what();
    }
  }
  EXPECT_EQ(most, 6U);
}

TEST(McapLog, WhatIsNoMeasurementIsLeftOutByAReaderOfLogs) {
  Log log = awkward_log();
  log.events.resize(4);
  std::get<Odometry>(log.events[0].payload).T_odom_base.x = std::nan("");
  log.events[1].payload = std::make_shared<const LaserScan>();
  log.events[2].stamp = Time::max();
  const Log got = read(written(log));
  EXPECT_EQ(count(got, "malformed message"), 3);
  EXPECT_EQ(got.events.size(), 1U);
}

TEST(McapLog, AnEventThatDoesNotFitItsStreamIsRefused) {
  Log log = awkward_log();
  log.events[0].stream = 1;
  EXPECT_THROW(written(log), InputError);
  log.events[0].stream = 9;
  EXPECT_THROW(written(log), InputError);
}

TEST(McapLog, ABagOfRos2IsReadWithItsMounts) {
  mcap::Writer writer({"ros2", "test"}, mcap::Compression::kZstd);
  const auto channel = [&](std::string_view topic, std::string_view type, std::string_view encoding = "cdr") {
    return writer.add_channel(writer.add_schema(type, "ros2msg", ""), topic, encoding);
  };
  ros::StampedTransform mount;
  mount.header.frame_id = "base_link";
  mount.child_frame_id = "laser";
  mount.T_parent_child = ros2::rigid({0.5, 0.0, 0.25});
  ros::StampedTransform odometry = mount;
  odometry.header = {Time(Duration(3'000'000'000)), "odom"};
  odometry.child_frame_id = "base_link";
  const ros::LaserScanMessage scan{{Time(Duration(4'000'000'000)), "laser"},
                                   {{}, 0.0, 0.1, 0.0, 9.0, {1, 2, 3}}};
  writer.add_message({channel("/tf_static", ros2::kTransforms), 0, 1, 1, ros2::encode_transforms({mount})});
  const std::string packed = pack_zstd_frame(ros2::encode_odometry(odometry));
  writer.add_message({channel("/odom", ros2::kOdometry), 0, 2, 2, packed});  // rosbag2's mode MESSAGE
  writer.add_message(
      {channel("/scan", ros2::kLaserScan), 0, 3, 3, ros2::encode_laser_scan(scan, cdr::ByteOrder::kBig)});
  writer.add_message({channel("/imu", "sensor_msgs/msg/Imu"), 0, 4, 4, "anything"});
  writer.add_message({channel("/json", ros2::kLaserScan, "json"), 0, 4, 4, "{}"});
  writer.add_message({channel("/bad", ros2::kLaserScan), 0, 4, 4, "\x28\xb5\x2f\xfd no zstd"});
  writer.finish();
  const Log log = read(writer.take());
  EXPECT_EQ(log.format, "mcap");
  ASSERT_EQ(log.streams.size(), 2U);
  EXPECT_EQ(log.streams[0].name, "/odom");
  EXPECT_EQ(log.streams[1].name, "/scan");
  ASSERT_TRUE(log.streams[1].T_base_sensor.has_value());
  EXPECT_NEAR(log.streams[1].T_base_sensor->theta, 0.25, 1e-15);
  EXPECT_EQ(log.events.at(1).stamp, Time(Duration(4'000'000'000)));
  EXPECT_EQ(log.events.at(1).arrival, Time(Duration(3)));
  EXPECT_EQ(count(log, "unsupported message (sensor_msgs/msg/Imu)"), 1);
  EXPECT_EQ(count(log, "unsupported message (sensor_msgs/msg/LaserScan as json)"), 1);
  EXPECT_EQ(count(log, "malformed message"), 1);
}

}  // namespace
}  // namespace cairn
