#include "cairn/io/ros1_log.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "rosbag_writer.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn::ros1 {
namespace {

using test::Bytes;
using test::ScanFields;
using test::TransformFields;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

class Ros1LogTest : public testing::Test {
 protected:
  void add(std::string_view type, std::string_view md5sum, std::string_view topic, const std::string& bytes) {
    ++arrival_;
    log_.add({type, topic, Time(std::chrono::seconds(arrival_)), bytes, 4117}, md5sum);
  }
  void scan(const ScanFields& fields) { raw_scan(test::scan_message(fields)); }
  void raw_scan(const std::string& bytes) {
    add("sensor_msgs/LaserScan", test::kLaserScanMd5, "/scan", bytes);
  }
  void odometry(const TransformFields& fields) {
    add("nav_msgs/Odometry", test::kOdometryMd5, "/odom", test::odometry_message(fields));
  }
  void transforms(const std::vector<TransformFields>& fields) {
    add("tf2_msgs/TFMessage", test::kTransformsMd5, "/tf", test::transforms_message(fields));
  }
  Log finish() { return std::move(log_).finish(); }

  static std::int64_t count(const Log& log, const std::string& kind) {
    const auto found = log.diagnostics.counts().find(kind);
    return found == log.diagnostics.counts().end() ? 0 : found->second;
  }
  static const LaserScan& scan_of(const Log& log, std::size_t event) {
    return *std::get<std::shared_ptr<const LaserScan>>(log.events.at(event).payload);
  }
  static Pose2 pose_of(const Log& log, std::size_t event) {
    return std::get<Odometry>(log.events.at(event).payload).T_odom_base;
  }
  static void expect_near(const Pose2& actual, const Pose2& expected) {
    EXPECT_NEAR(actual.x, expected.x, 1e-12);
    EXPECT_NEAR(actual.y, expected.y, 1e-12);
    EXPECT_NEAR(angle_difference(actual.theta, expected.theta), 0.0, 1e-12);
  }
  static void expect_mount(const Log& log, const Pose2& expected) {
    const auto& T_base_sensor = log.streams.at(0).T_base_sensor;
    ASSERT_TRUE(T_base_sensor.has_value());
    expect_near(*T_base_sensor, expected);
  }

  Ros1Log log_{"test.bag"};
  int arrival_ = 1000;
};

// --- messages
// -----------------------------------------------------------------------------------------------

TEST_F(Ros1LogTest, KeepsAScanAsRecorded) {
  const float nan = std::nanf("");
  scan(
      {.stamp = {7, 5}, .frame = "/front", .range_max = 8.0f, .ranges = {0.0f, kInfinity, nan, 4.5f, 99.0f}});
  const Log log = finish();
  ASSERT_EQ(log.events.size(), 1u);
  const LaserScan& scan = scan_of(log, 0);
  EXPECT_EQ(log.streams[0].frame, "front");
  EXPECT_EQ(log.events[0].stamp, Time(std::chrono::seconds(7) + std::chrono::nanoseconds(5)));
  EXPECT_EQ(scan.stamp, log.events[0].stamp);
  EXPECT_EQ(log.events[0].arrival, Time(std::chrono::seconds(1001)));
  EXPECT_THAT(scan.ranges_m, testing::ElementsAre(0.0f, kInfinity, testing::IsNan(), 4.5f, 99.0f));
  EXPECT_EQ(scan.angle_min_rad, -0.5);
  EXPECT_EQ(scan.angle_increment_rad, 0.5);
  EXPECT_EQ(scan.range_min_m, static_cast<double>(0.1f));
  EXPECT_EQ(scan.range_max_m, 8.0);
}

TEST_F(Ros1LogTest, AScanOfNaNOnlyIsAScan) {
  scan({.ranges = std::vector<float>(3, std::nanf(""))});
  EXPECT_EQ(finish().events.size(), 1u);
}

TEST_F(Ros1LogTest, EveryCutOfAScanIsMalformed) {
  const std::string whole = test::scan_message({});
  for (std::size_t size = 0; size < whole.size(); ++size) raw_scan(whole.substr(0, size));
  const Log log = finish();
  EXPECT_TRUE(log.events.empty());
  EXPECT_EQ(count(log, "malformed message"), static_cast<std::int64_t>(whole.size()));
}

TEST_F(Ros1LogTest, AnnouncedBeamsAreNotBelieved) {
  const std::string whole = test::scan_message({});
  const std::size_t beams = test::ros_header({}, "laser").size() + 7 * sizeof(float);
  for (const std::uint32_t announced : {1'000'000'000u, 0x40000000u, 0xffffffffu, 0x80000000u, 5u}) {
    std::string bytes = whole;
    raw_scan(bytes.replace(beams, 4, Bytes().number(announced).text()));
  }
  const Log log = finish();
  EXPECT_EQ(count(log, "malformed message"), 5);
  EXPECT_THAT(log.diagnostics.examples().at(0).text,
              testing::AllOf(testing::HasSubstr("test.bag (byte offset 4117)"),
                             testing::HasSubstr("announces more beams than it holds")));
}

TEST_F(Ros1LogTest, ScansWithoutSenseAreMalformed) {
  const float nan = std::nanf("");
  scan({.ranges = {}});
  scan({.angle_min = nan});
  scan({.angle_min = -90.0f});  // degrees
  scan({.angle_increment = kInfinity});
  scan({.angle_increment = 0.0f});
  scan({.angle_increment = 10.0f});
  scan({.range_min = nan});
  scan({.range_min = -1.0f});
  scan({.range_min = 2.0f, .range_max = 1.0f});
  scan({.range_max = nan});
  scan({.stamp = {1, 1'000'000'000}});
  const Log log = finish();
  EXPECT_TRUE(log.events.empty());
  EXPECT_EQ(count(log, "malformed message"), 11);
}

TEST_F(Ros1LogTest, OdometryGivesThePlanarPose) {
  odometry({.stamp = {5, 0}, .position = {1.0, 2.0, 0.3}, .rotation = test::yaw(-2.5)});
  const Log log = finish();
  ASSERT_EQ(log.streams.size(), 1u);
  EXPECT_EQ(log.streams[0].name, "/odom");
  EXPECT_EQ(log.streams[0].kind, StreamKind::kOdometry);
  expect_near(pose_of(log, 0), {1.0, 2.0, -2.5});
}

TEST_F(Ros1LogTest, PosesWithoutSenseAreMalformed) {
  odometry({.position = {kNaN, 0.0, 0.0}});
  odometry({.position = {0.0, -2e7, 0.0}});
  odometry({.rotation = {0.0, 0.0, 0.0, 0.0}});
  odometry({.rotation = {0.0, 0.0, kNaN, 1.0}});
  odometry({.rotation = {0.0, 0.0, 0.0, 90.0}});
  add("nav_msgs/Odometry", test::kOdometryMd5, "/odom", test::transform_bytes({}));  // no covariances
  const Log log = finish();
  EXPECT_TRUE(log.events.empty());
  EXPECT_EQ(count(log, "malformed message"), 6);
}

TEST_F(Ros1LogTest, TransformsWithoutSenseAreSkippedOneByOne) {
  transforms({{.position = {kNaN, 0.0, 0.0}}, {.position = {1.0, 0.0, 0.0}}});
  const Log log = finish();
  EXPECT_EQ(log.events.size(), 1u);
  EXPECT_EQ(count(log, "malformed transform"), 1);
}

TEST_F(Ros1LogTest, AnnouncedTransformsAreNotBelieved) {
  for (const std::uint32_t announced : {2u, 1'000'000'000u, 0xffffffffu}) {
    std::string bytes = test::transforms_message({{}});
    add("tf/tfMessage", test::kTransformsMd5, "/tf", bytes.replace(0, 4, Bytes().number(announced).text()));
  }
  EXPECT_EQ(count(finish(), "malformed message"), 3);
}

TEST_F(Ros1LogTest, OtherTypesAndVersionsAreCountedPerType) {
  add("sensor_msgs/Imu", "6a62c6daae103f4ff57a132d6f95cec2", "/imu", "");
  add("sensor_msgs/Imu", "6a62c6daae103f4ff57a132d6f95cec2", "/imu", "");
  add("std_msgs/Str\xffing", "x", "/s", "");
  add("sensor_msgs/LaserScan", "0000", "/scan", test::scan_message({}));
  const Log log = finish();
  EXPECT_EQ(count(log, "unsupported message (sensor_msgs/Imu)"), 2);
  EXPECT_EQ(count(log, "unsupported message (std_msgs/Str?ing)"), 1);
  EXPECT_EQ(count(log, "unsupported message (sensor_msgs/LaserScan of version 0000)"), 1);
  EXPECT_EQ(count(log, "malformed message"), 0);
}

TEST_F(Ros1LogTest, StampsRunningBackwardsAreCountedPerStream) {
  for (std::uint32_t t : {10u, 12u, 11u, 13u, 2u}) scan({.stamp = {t, 0}});
  odometry({.stamp = {1, 0}});
  const Log log = finish();
  EXPECT_EQ(log.events.size(), 6u);
  EXPECT_EQ(count(log, "time reversal"), 2);
}

TEST_F(Ros1LogTest, WithoutAStampTheArrivalCounts) {
  scan({.stamp = {0, 0}});
  const Log log = finish();
  EXPECT_EQ(log.events.at(0).stamp, Time(std::chrono::seconds(1001)));
  EXPECT_EQ(scan_of(log, 0).stamp, log.events[0].stamp);
  EXPECT_EQ(count(log, "no stamp"), 1);
}

TEST_F(Ros1LogTest, ATopicThatChangesItsFrameBecomesTwoStreams) {
  scan({.frame = "front"});
  scan({.frame = "rear"});
  scan({.frame = "front"});
  const Log log = finish();
  ASSERT_EQ(log.streams.size(), 2u);
  EXPECT_EQ(log.streams[1].name, "/scan (rear)");
  EXPECT_EQ(log.events[2].stream, 0);
}

TEST_F(Ros1LogTest, MoreMessagesThanAllowedAreAnError) {
  log_ = Ros1Log("small.bag", 1000);
  scan({});
  EXPECT_THROW(scan({.angle_increment = 0.001f, .ranges = std::vector<float>(1000, 1.0f)}), InputError);
}

TEST_F(Ros1LogTest, TheNumberOfStreamsIsBounded) {
  for (int i = 0; i < 300; ++i) scan({.frame = "laser" + std::to_string(i)});
  const Log log = finish();
  EXPECT_EQ(log.streams.size(), 256u);
  EXPECT_EQ(count(log, "malformed message"), 44);
}

// --- frames
// -------------------------------------------------------------------------------------------------

TEST_F(Ros1LogTest, TransformsOfTheBaseAreAnOdometryStream) {
  transforms(
      {{.parent = "/odom", .child = "/base_footprint", .position = {1, 2, 0}, .rotation = test::yaw(0.4)},
       {.parent = "map", .child = "odom"},
       {.parent = "odom", .child = "landmark"}});
  const Log log = finish();
  ASSERT_EQ(log.streams.size(), 1u);
  EXPECT_EQ(log.streams[0].name, "tf:odom->base_footprint");
  EXPECT_EQ(log.streams[0].frame, "odom");
  ASSERT_EQ(log.events.size(), 1u);
  expect_near(pose_of(log, 0), {1.0, 2.0, 0.4});
}

TEST_F(Ros1LogTest, ResolvesAMountOverAChain) {
  scan({});
  transforms(
      {{.parent = "odom", .child = "base_footprint"},
       {.parent = "base_footprint",
        .child = "base_link",
        .position = {0, 0, 0.2},
        .rotation = test::yaw(kPi / 2)},
       {.parent = "base_link", .child = "laser", .position = {0.5, 0, 0.1}, .rotation = test::yaw(0.25)}});
  expect_mount(finish(), {0.0, 0.5, kPi / 2 + 0.25});
}

TEST_F(Ros1LogTest, ResolvesAMountAgainstTheDirectionOfTheTree) {
  scan({});
  transforms({{.parent = "odom", .child = "base_link"},
              {.parent = "laser", .child = "base_link", .position = {-0.3, 0, 0}}});
  expect_mount(finish(), {0.3, 0.0, 0.0});
}

TEST_F(Ros1LogTest, WithoutTfOfTheBaseTheOdometryTopicNamesIt) {
  scan({});
  odometry({.child = "chassis"});
  transforms({{.parent = "chassis", .child = "laser", .position = {0.7, 0.1, 0}}});
  expect_mount(finish(), {0.7, 0.1, 0.0});
}

TEST_F(Ros1LogTest, WithoutOdometryTheUsualNamesServe) {
  scan({});
  transforms({{.parent = "base_link", .child = "laser", .position = {0.7, 0.1, 0}}});
  expect_mount(finish(), {0.7, 0.1, 0.0});
}

TEST_F(Ros1LogTest, AMovingOrUnknownMountStaysUnknown) {
  scan({});
  scan({.frame = "other"});
  for (double angle : {0.0, 0.1}) {
    transforms({{.parent = "odom", .child = "base_link"},
                {.parent = "base_link", .child = "laser", .rotation = test::yaw(angle)}});
  }
  const Log log = finish();
  EXPECT_FALSE(log.streams.at(0).T_base_sensor.has_value());
  EXPECT_FALSE(log.streams.at(1).T_base_sensor.has_value());
  EXPECT_EQ(count(log, "unknown mount"), 2);
}

TEST_F(Ros1LogTest, ATiltedLaserHasNoPlanarMount) {
  scan({});
  transforms({{.parent = "base_link", .child = "laser", .rotation = {0, std::sin(0.1), 0, std::cos(0.1)}}});
  const Log log = finish();
  EXPECT_FALSE(log.streams.at(0).T_base_sensor.has_value());
  EXPECT_EQ(count(log, "unknown mount"), 1);
}

// The end points of a mirrored scan, seen through the planar mount, lie where the full rotation puts them.
TEST_F(Ros1LogTest, AnInvertedLaserSeesTheSamePoints) {
  const double heading = 0.6;
  const Eigen::Quaterniond rotation =
      Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(kPi, Eigen::Vector3d::UnitX());
  scan({.angle_min = -1.0f, .angle_increment = 0.75f, .ranges = {1.0f, 2.0f, 3.0f}});
  transforms({{.parent = "base_link",
               .child = "laser",
               .position = {0.2, 0.1, 0.9},
               .rotation = {rotation.x(), rotation.y(), rotation.z(), rotation.w()}}});
  const Log log = finish();
  EXPECT_EQ(count(log, "inverted laser"), 1);
  expect_mount(log, {0.2, 0.1, heading});
  const LaserScan& mirrored = scan_of(log, 0);
  EXPECT_THAT(mirrored.ranges_m, testing::ElementsAre(1.0f, 2.0f, 3.0f));
  for (int beam = 0; beam < 3; ++beam) {
    const double range = beam + 1.0;
    const double recorded = -1.0 + 0.75 * beam;
    const Eigen::Vector3d point =
        rotation * Eigen::Vector3d(range * std::cos(recorded), range * std::sin(recorded), 0) +
        Eigen::Vector3d(0.2, 0.1, 0.9);
    const double angle = mirrored.angle_min_rad + beam * mirrored.angle_increment_rad;
    const Point2 planar_point =
        *log.streams[0].T_base_sensor * Point2{range * std::cos(angle), range * std::sin(angle)};
    EXPECT_NEAR(planar_point.x, point.x(), 1e-12);
    EXPECT_NEAR(planar_point.y, point.y(), 1e-12);
  }
}

TEST_F(Ros1LogTest, OdometryOfAnotherFrameIsCarriedToTheBase) {
  odometry({.child = "axle", .position = {5, 0, 0}, .rotation = test::yaw(kPi / 2)});
  transforms({{.parent = "odom", .child = "base_link"},
              {.parent = "base_link", .child = "axle", .position = {-0.4, 0, 0}}});
  const Log log = finish();
  expect_near(pose_of(log, 0), {5.0, 0.4, kPi / 2});
  EXPECT_TRUE(log.diagnostics.empty());
}

TEST_F(Ros1LogTest, OdometryOfAnUnconnectedFrameIsReported) {
  odometry({.child = "axle"});
  transforms({{.parent = "odom", .child = "base_link"}});
  EXPECT_EQ(count(finish(), "odometry of another frame"), 1);
}

TEST_F(Ros1LogTest, ACircleOfFramesEnds) {
  scan({.frame = "elsewhere"});
  transforms({{.parent = "base_link", .child = "a"},
              {.parent = "a", .child = "b"},
              {.parent = "b", .child = "base_link"},
              {.parent = "base_link", .child = "base_link"}});
  EXPECT_FALSE(finish().streams.at(0).T_base_sensor.has_value());
}

}  // namespace
}  // namespace cairn::ros1
