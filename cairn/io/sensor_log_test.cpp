#include "bad_input.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/carmen_writer.hpp"
#include "cairn/io/cdr.hpp"
#include "cairn/io/exact_messages.hpp"
#include "cairn/io/log_summary.hpp"
#include "cairn/io/mcap_log.hpp"
#include "cairn/io/mcap_log_writer.hpp"
#include "cairn/io/mcap_reader.hpp"
#include "cairn/io/ros2_messages.hpp"
#include "every_sensor.hpp"
#include "log_inspection.hpp"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

Log log_of_every_sensor() {
  test::EverySensor all = test::every_sensor();
  return {"", std::move(all.streams), std::move(all.events), {}};
}

std::string written(const Log& log, mcap::Compression compression = mcap::Compression::kZstd) {
  std::ostringstream output;
  write_mcap_log(output, log, compression);
  return output.str();
}

Log read(const std::string& bytes) {
  std::istringstream input(bytes);
  return read_mcap_log(input, "a.mcap");
}

// The bytes of the first message on each topic.
std::map<std::string, std::string> first_messages(const std::string& bytes) {
  std::map<std::string, std::string> first;
  mcap::Handlers handlers;
  handlers.on_message = [&first](const mcap::MessageView& m) {
    first.emplace(m.channel.topic, m.message.data);
  };
  std::istringstream input(bytes);
  Diagnostics diagnostics;
  mcap::read(input, "a", handlers, diagnostics);
  return first;
}

TEST(SensorLog, EverySensorComesBackToTheLastBit) {
  const Log sent = log_of_every_sensor();
  for (const auto compression :
       {mcap::Compression::kNone, mcap::Compression::kLz4, mcap::Compression::kZstd}) {
    const Log got = read(written(sent, compression));
    EXPECT_TRUE(got.diagnostics.empty()) << test::first_example(got);
    ASSERT_EQ(got.streams.size(), kStreamKinds);
    for (std::size_t i = 0; i < kStreamKinds; ++i) {
      EXPECT_EQ(got.streams[i].name, sent.streams[i].name);
      EXPECT_EQ(got.streams[i].kind, sent.streams[i].kind);
      EXPECT_EQ(got.streams[i].T_base_sensor, sent.streams[i].T_base_sensor);
    }
    ASSERT_EQ(got.events.size(), sent.events.size());
    for (std::size_t i = 0; i < got.events.size(); ++i) {
      EXPECT_EQ(got.events[i].stream, sent.events[i].stream);
      EXPECT_EQ(exact::encode(got.events[i]), exact::encode(sent.events[i])) << i;
    }
  }
}

TEST(SensorLog, MessagesCutAnywhereAreRefused) {
  for (const Event& event : log_of_every_sensor().events) {
    const std::string whole = exact::encode(event);
    for (std::size_t size = 0; size < whole.size(); ++size) {
      EXPECT_THROW(exact::decode(kind_of(event), 0, whole.substr(0, size)), ros::MalformedMessage)
          << name_of(kind_of(event)) << " " << size;
    }
  }
}

TEST(SensorLog, WhatMakesNoSenseIsLeftOutAndCounted) {
  Log log = log_of_every_sensor();
  for (Event& event : log.events) {
    if (auto* rate = std::get_if<ImuYawRate>(&event.payload)) rate->yaw_rate_radps = 1e9;
    if (std::holds_alternative<std::shared_ptr<const CeilingPatch>>(event.payload))
      event.payload = std::make_shared<const CeilingPatch>(CeilingPatch{event.stamp, 4, 4, 0.01, {1, 2}});
  }
  const Log got = read(written(log));
  EXPECT_EQ(test::count(got, "malformed message"), 4);
  EXPECT_EQ(got.events.size(), log.events.size() - 4);
}

TEST(SensorLog, AnEventWithoutAMeasurementIsRefused) {
  Log log = log_of_every_sensor();
  log.events[3].payload = std::shared_ptr<const DepthImage>();
  EXPECT_THROW(written(log), InputError);
}

TEST(SensorLog, OtherToolsFindTheTopicsOfRos) {
  const auto first = first_messages(written(log_of_every_sensor()));
  for (const char* topic : {"/sonar_scan", "/depth_image", "/depth_image/camera_info", "/ceiling_patch",
                            "/imu_yaw_rate", "/laser_scan", "/odometry", "/tf_static"})
    EXPECT_TRUE(first.contains(topic)) << topic;
  for (const char* topic : {"/wifi_scan", "/beacon_ranges", "/landmark_detections"})
    EXPECT_FALSE(first.contains(topic)) << topic;
}

// The fields of sensor_msgs/Image, read as its definition has them.
TEST(SensorLog, ADepthImageIsAnImageOfRos) {
  const auto first = first_messages(written(log_of_every_sensor()));
  cdr::Reader image(first.at("/depth_image"));
  EXPECT_EQ(image.number<std::int32_t>(), 0);  // the stamp is 1 ns
  EXPECT_EQ(image.number<std::uint32_t>(), 1U);
  EXPECT_EQ(image.text(), "sensor_3");
  EXPECT_EQ(image.number<std::uint32_t>(), 2U) << "height";
  EXPECT_EQ(image.number<std::uint32_t>(), 3U) << "width";
  EXPECT_EQ(image.text(), "16UC1");
  EXPECT_EQ(image.number<std::uint8_t>(), 0U) << "little endian";
  EXPECT_EQ(image.number<std::uint32_t>(), 6U) << "bytes in a row";
  const auto bytes = image.numbers<std::uint8_t>();
  ASSERT_EQ(bytes.size(), 12U);
  EXPECT_EQ(bytes[6] + 256 * bytes[7], 400);
  EXPECT_TRUE(image.ok());
}

TEST(SensorLog, ASonarIsRangesOfRosOnTheirFrames) {
  const std::string bytes = written(log_of_every_sensor());
  std::vector<float> ranges;
  std::vector<std::string> frames;
  mcap::Handlers handlers;
  handlers.on_message = [&](const mcap::MessageView& m) {
    if (m.channel.topic != "/sonar_scan") return;
    cdr::Reader range(m.message.data);
    range.number<std::int32_t>();
    range.number<std::uint32_t>();
    frames.emplace_back(range.text());
    range.number<std::uint8_t>();
    range.skip(3, sizeof(float));
    ranges.push_back(range.number<float>());
    EXPECT_TRUE(range.ok());
  };
  std::istringstream input(bytes);
  Diagnostics diagnostics;
  mcap::read(input, "a", handlers, diagnostics);
  EXPECT_THAT(frames, testing::ElementsAre("sensor_2_0", "sensor_2_1", "sensor_2_0", "sensor_2_1"));
  ASSERT_EQ(ranges.size(), 4U);
  EXPECT_EQ(ranges[0], 1.5F);
  EXPECT_EQ(ranges[1], std::numeric_limits<float>::infinity()) << "no echo";
  const auto mounts = ros2::decode_transforms(first_messages(bytes).at("/tf_static"));
  EXPECT_EQ(mounts.size(), kStreamKinds) << "those of the sensors; odometry has one here, too";
}

TEST(SensorLog, AnImuSaysWhatItDoesNotMeasure) {
  const auto messages = first_messages(written(log_of_every_sensor()));
  cdr::Reader imu(messages.at("/imu_yaw_rate"));
  imu.number<std::int32_t>();
  imu.number<std::uint32_t>();
  imu.text();
  imu.skip(4, sizeof(double));
  EXPECT_EQ(imu.number<double>(), -1.0) << "no orientation";
  imu.skip(8 + 2, sizeof(double));
  EXPECT_EQ(imu.number<double>(), -1.0 / 3.0);
  imu.skip(9 + 3, sizeof(double));
  EXPECT_EQ(imu.number<double>(), -1.0) << "no acceleration";
  imu.skip(8, sizeof(double));
  EXPECT_TRUE(imu.ok());
}

TEST(SensorLog, IsSummarized) {
  const LogSummary summary = summarize(log_of_every_sensor());
  ASSERT_EQ(summary.streams.size(), kStreamKinds);
  const auto sensor = [&](StreamKind kind) {
    return *summary.streams[static_cast<std::size_t>(kind)].sensor;
  };
  EXPECT_FALSE(summary.streams[0].sensor.has_value());
  EXPECT_FALSE(summary.streams[1].sensor.has_value());
  EXPECT_DOUBLE_EQ(sensor(StreamKind::kSonarScan).valid_share, 0.5);
  EXPECT_EQ(sensor(StreamKind::kDepthImage).readings_max, 6U);
  EXPECT_DOUBLE_EQ(sensor(StreamKind::kDepthImage).valid_share, 8.0 / 12.0);
  EXPECT_DOUBLE_EQ(sensor(StreamKind::kBeaconRanges).valid_share, 0.5);
  EXPECT_DOUBLE_EQ(sensor(StreamKind::kLandmarkDetections).valid_share, 0.5);
  EXPECT_EQ(sensor(StreamKind::kImuYawRate).readings_min, 1U);
  EXPECT_THAT(to_json(summary), testing::HasSubstr("\"kind\": \"wifi_scan\""));
}

TEST(SensorLog, CarmenTextCannotHoldIt) {
  std::ostringstream output;
  const auto write = [&](std::istream&) { write_carmen_log(output, log_of_every_sensor()); };
  EXPECT_THAT(test::error_on(write, ""), testing::HasSubstr("'sonar_scan' of sonar_scan"));
}

}  // namespace
}  // namespace cairn
