#include "cairn/io/ros2_messages.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/io/ros2_schemas.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn::ros2 {
namespace {

using cdr::ByteOrder;

ros::LaserScanMessage small_scan() {
  const Time stamp(Duration(1'700'000'000'123'456'789));
  const float nan = std::nanf("");
  return {{stamp, "laser"},
          {stamp, -0.5, 0.25, 0.125, 8.0, {1.0F, nan, std::numeric_limits<float>::infinity(), 0.0F}}};
}

ros::StampedTransform small_transform(const std::string& parent = "odom",
                                      const std::string& child = "base_link") {
  ros::StampedTransform transform;
  transform.header = {Time(Duration(5)), parent};
  transform.child_frame_id = child;
  transform.T_parent_child = rigid({1.0, -2.0, 2.5});
  return transform;
}

class Ros2ByteOrder : public testing::TestWithParam<ByteOrder> {};
INSTANTIATE_TEST_SUITE_P(Orders, Ros2ByteOrder, testing::Values(ByteOrder::kLittle, ByteOrder::kBig));

TEST_P(Ros2ByteOrder, AScanComesBack) {
  const ros::LaserScanMessage sent = small_scan();
  const ros::LaserScanMessage got = decode_laser_scan(encode_laser_scan(sent, GetParam()));
  EXPECT_EQ(got.header.stamp, sent.header.stamp);
  EXPECT_EQ(got.header.frame_id, "laser");
  EXPECT_EQ(got.scan.stamp, sent.header.stamp);
  EXPECT_EQ(got.scan.angle_min_rad, -0.5);
  EXPECT_EQ(got.scan.angle_increment_rad, 0.25);
  EXPECT_EQ(got.scan.range_min_m, 0.125);
  EXPECT_EQ(got.scan.range_max_m, 8.0);
  EXPECT_THAT(got.scan.ranges_m,
              testing::ElementsAre(1.0F, testing::IsNan(), std::numeric_limits<float>::infinity(), 0.0F));
}

TEST_P(Ros2ByteOrder, OdometryAndTransformsComeBack) {
  const auto check = [](const ros::StampedTransform& got) {
    EXPECT_EQ(got.header.stamp, Time(Duration(5)));
    EXPECT_EQ(got.header.frame_id, "odom");
    EXPECT_EQ(got.child_frame_id, "base_link");
    const Pose2 pose = ros::planar(got.T_parent_child.value());
    EXPECT_NEAR(pose.x, 1.0, 1e-15);
    EXPECT_NEAR(pose.y, -2.0, 1e-15);
    EXPECT_NEAR(pose.theta, 2.5, 1e-15);
  };
  check(decode_odometry(encode_odometry(small_transform(), GetParam())));
  const auto transforms =
      decode_transforms(encode_transforms({small_transform(), small_transform()}, GetParam()));
  ASSERT_EQ(transforms.size(), 2U);
  for (const ros::StampedTransform& transform : transforms) check(transform);
}

TEST_P(Ros2ByteOrder, EveryCutIsMalformed) {
  const auto cut_all = [](const std::string& whole, const auto& decode) {
    for (std::size_t size = 0; size < whole.size(); ++size) {
      EXPECT_THROW(decode(std::string_view(whole).substr(0, size)), ros::MalformedMessage) << size;
    }
  };
  cut_all(encode_laser_scan(small_scan(), GetParam()), decode_laser_scan);
  cut_all(encode_odometry(small_transform(), GetParam()), decode_odometry);
  cut_all(encode_transforms({small_transform()}, GetParam()), decode_transforms);
}

TEST(Ros2Messages, StampsBeforeTheEpochAndBeyondAMessage) {
  ros::StampedTransform transform = small_transform();
  const auto stamp_back = [&](std::int64_t nanoseconds) {
    transform.header.stamp = Time(Duration(nanoseconds));
    return decode_odometry(encode_odometry(transform)).header.stamp.time_since_epoch().count();
  };
  EXPECT_EQ(stamp_back(-1), -1);
  EXPECT_EQ(stamp_back(-2'500'000'000), -2'500'000'000);
  EXPECT_EQ(stamp_back(std::int64_t{3'000'000'000} * 1'000'000'000) / 1'000'000'000, 2'147'483'647);
}

TEST(Ros2Messages, APoseWithoutSenseIsMalformed) {
  std::string bytes = encode_odometry(small_transform());
  const std::size_t x = bytes.find(cdr::Writer().number(1.0).bytes().substr(4));
  ASSERT_NE(x, std::string::npos);
  bytes.replace(x, 8, cdr::Writer().number(std::nan("")).bytes().substr(4));
  EXPECT_THROW(decode_odometry(bytes), ros::MalformedMessage);
}

TEST(Ros2Messages, TheCovarianceOfAPlanarPoseHasItsPlaces) {
  Eigen::Matrix3d covariance;
  covariance << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  const std::string bytes = encode_pose({Time(), "map"}, {10.0, 20.0, 0.0}, covariance);
  cdr::Reader fields(bytes);
  fields.skip(2, 4);
  EXPECT_EQ(fields.text(), "map");
  std::vector<double> values(7 + 36);
  for (double& value : values) value = fields.number<double>();
  EXPECT_TRUE(fields.ok());
  EXPECT_THAT(std::vector(values.begin(), values.begin() + 7), testing::ElementsAre(10, 20, 0, 0, 0, 0, 1));
  const auto entry = [&](std::size_t row, std::size_t column) { return values[7 + 6 * row + column]; };
  EXPECT_EQ(entry(0, 1), 2);
  EXPECT_EQ(entry(0, 5), 3);
  EXPECT_EQ(entry(5, 0), 7);
  EXPECT_EQ(entry(5, 5), 9);
  EXPECT_EQ(entry(2, 2), 0);
}

TEST(Ros2Schemas, HoldEveryMessageThatTheyNameOnce) {
  const std::string text = schema(kOdometry);
  EXPECT_TRUE(text.starts_with("std_msgs/Header header\nstring child_frame_id\n"));
  for (const char* part :
       {"std_msgs/Header", "builtin_interfaces/Time", "geometry_msgs/PoseWithCovariance",
        "geometry_msgs/Pose", "geometry_msgs/TwistWithCovariance", "geometry_msgs/Vector3"}) {
    const std::string heading = std::string(80, '=') + "\nMSG: " + part + "\n";
    EXPECT_NE(text.find(heading), std::string::npos) << part;
    EXPECT_EQ(text.find(heading), text.rfind(heading)) << part;
  }
}

}  // namespace
}  // namespace cairn::ros2
