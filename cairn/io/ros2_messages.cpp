#include "cairn/io/ros2_messages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace cairn::ros2 {
namespace {

using ros::Header;
using ros::LaserScanMessage;
using ros::require;
using ros::StampedTransform;

constexpr std::int64_t kNanoseconds = 1'000'000'000;

Header read_header(cdr::Reader& fields) {
  const std::int64_t seconds = fields.number<std::int32_t>();
  const std::int64_t nanoseconds = fields.number<std::uint32_t>();
  require(nanoseconds < kNanoseconds, "its stamp has more than 10^9 nanoseconds");
  return {Time(Duration(seconds * kNanoseconds + nanoseconds)), ros::frame_name(fields.text())};
}

std::optional<ros::RigidTransform> read_transform(cdr::Reader& fields) {
  std::array<double, 7> values;
  for (double& value : values) value = fields.number<double>();
  return ros::rigid_transform(values);
}

void put_transform(cdr::Writer& fields, const ros::RigidTransform& transform) {
  for (const double value : transform.position) fields.number(value);
  for (const double value : transform.rotation.coeffs()) fields.number(value);  // x y z w, as in the message
}

StampedTransform read_stamped_transform(cdr::Reader& fields) {
  StampedTransform transform;
  transform.header = read_header(fields);
  transform.child_frame_id = ros::frame_name(fields.text());
  transform.T_parent_child = read_transform(fields);
  require(fields.ok(), "it ends early");
  return transform;
}

void put_stamped_transform(cdr::Writer& fields, const StampedTransform& transform) {
  put_header(fields, transform.header);
  fields.text(transform.child_frame_id);
  put_transform(fields, transform.T_parent_child.value_or(ros::RigidTransform()));
}

void put_zeros(cdr::Writer& fields, int count) {
  for (int i = 0; i < count; ++i) fields.number(0.0);
}

}  // namespace

void put_header(cdr::Writer& fields, const ros::Header& header) {
  using Seconds = std::chrono::duration<std::int64_t>;
  const auto since_epoch = header.stamp.time_since_epoch();
  const auto seconds = std::chrono::floor<Seconds>(since_epoch).count();
  const auto nanoseconds = (since_epoch - std::chrono::floor<Seconds>(since_epoch)).count();
  constexpr std::int64_t kFirst = std::numeric_limits<std::int32_t>::min();
  constexpr std::int64_t kLast = std::numeric_limits<std::int32_t>::max();
  fields.number(static_cast<std::int32_t>(std::clamp(seconds, kFirst, kLast)));
  fields.number(static_cast<std::uint32_t>(nanoseconds)).text(header.frame_id);
}

LaserScanMessage decode_laser_scan(std::string_view bytes) {
  cdr::Reader fields(bytes);
  LaserScanMessage result{read_header(fields), {}};
  LaserScan& scan = result.scan;
  scan.stamp = result.header.stamp;
  scan.angle_min_rad = fields.number<float>();
  fields.number<float>();  // angle_max follows from the others
  scan.angle_increment_rad = fields.number<float>();
  fields.skip(2, sizeof(float));  // time_increment, scan_time: motion within the sweep is not modelled
  scan.range_min_m = fields.number<float>();
  scan.range_max_m = fields.number<float>();
  scan.ranges_m = fields.numbers<float>();
  fields.skip(fields.length(sizeof(float)), sizeof(float));  // intensities
  require(fields.ok(), "it ends early");
  ros::check_scan(scan);
  return result;
}

StampedTransform decode_odometry(std::string_view bytes) {
  cdr::Reader fields(bytes);
  StampedTransform odometry = read_stamped_transform(fields);
  fields.skip(36 + 6 + 36, sizeof(double));  // covariance of the pose, twist and its covariance
  require(fields.ok(), "it ends early");
  require(odometry.T_parent_child.has_value(), "its pose is not finite, or its rotation is none");
  return odometry;
}

std::vector<StampedTransform> decode_transforms(std::string_view bytes) {
  constexpr std::size_t kLeastBytes = 12 + 4 + 7 * sizeof(double);
  cdr::Reader fields(bytes);
  std::vector<StampedTransform> transforms;
  for (std::size_t i = fields.length(kLeastBytes); i > 0; --i)
    transforms.push_back(read_stamped_transform(fields));
  return transforms;
}

std::string encode_laser_scan(const LaserScanMessage& message, cdr::ByteOrder order) {
  const LaserScan& scan = message.scan;
  const double steps = static_cast<double>(std::max<std::size_t>(scan.ranges_m.size(), 1) - 1);
  const double angle_max_rad = scan.angle_min_rad + scan.angle_increment_rad * steps;
  cdr::Writer fields(order);
  put_header(fields, message.header);
  for (const double value : {scan.angle_min_rad, angle_max_rad, scan.angle_increment_rad, 0.0, 0.0,
                             scan.range_min_m, scan.range_max_m}) {
    fields.number(static_cast<float>(value));
  }
  fields.numbers(std::span<const float>(scan.ranges_m)).numbers(std::span<const float>());
  return std::move(fields).bytes();
}

std::string encode_odometry(const StampedTransform& odometry, cdr::ByteOrder order) {
  cdr::Writer fields(order);
  put_stamped_transform(fields, odometry);
  put_zeros(fields, 36 + 6 + 36);
  return std::move(fields).bytes();
}

std::string encode_transforms(const std::vector<StampedTransform>& transforms, cdr::ByteOrder order) {
  cdr::Writer fields(order);
  fields.length(transforms.size());
  for (const StampedTransform& transform : transforms) put_stamped_transform(fields, transform);
  return std::move(fields).bytes();
}

std::string encode_pose(const Header& header, const Pose2& pose, const Eigen::Matrix3d& covariance) {
  constexpr std::array<int, 3> kPlanar{0, 1, 5};  // of x y z and the rotations about them
  Eigen::Matrix<double, 6, 6> full = Eigen::Matrix<double, 6, 6>::Zero();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) full(kPlanar[row], kPlanar[column]) = covariance(row, column);
  }
  cdr::Writer fields;
  put_header(fields, header);
  put_transform(fields, rigid(pose));
  for (const double value : full.reshaped<Eigen::RowMajor>()) fields.number(value);
  return std::move(fields).bytes();
}

ros::RigidTransform rigid(const Pose2& pose) {
  return {{pose.x, pose.y, 0.0}, {std::cos(pose.theta / 2.0), 0.0, 0.0, std::sin(pose.theta / 2.0)}};
}

}  // namespace cairn::ros2
