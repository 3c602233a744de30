#include "cairn/io/ros1_messages.hpp"

#include "cairn/io/byte_reader.hpp"
#include "cairn/io/rosbag1_records.hpp"

#include <array>
#include <cstring>

namespace cairn::ros1 {
namespace {

using ros::Header;
using ros::LaserScanMessage;
using ros::require;
using ros::StampedTransform;

std::string read_frame(ByteReader& bytes) { return ros::frame_name(bytes.block()); }

Header read_header(ByteReader& bytes) {
  bytes.number<std::uint32_t>();  // seq
  const auto seconds = bytes.number<std::uint32_t>();
  const auto nanoseconds = bytes.number<std::uint32_t>();
  require(nanoseconds < 1'000'000'000, "its stamp has more than 10^9 nanoseconds");
  return {rosbag1::ros_time(seconds, nanoseconds), read_frame(bytes)};
}

std::vector<float> read_floats(ByteReader& bytes) {
  const std::size_t count = bytes.number<std::uint32_t>();
  require(count <= bytes.remaining() / sizeof(float), "it announces more beams than it holds");
  const std::string_view raw = bytes.take(count * sizeof(float));
  std::vector<float> values(count);
  if (count > 0) std::memcpy(values.data(), raw.data(), raw.size());
  return values;
}

std::optional<ros::RigidTransform> read_transform(ByteReader& bytes) {
  std::array<double, 7> values;
  for (double& value : values) value = bytes.number<double>();
  return ros::rigid_transform(values);
}

StampedTransform read_stamped_transform(ByteReader& bytes) {
  StampedTransform transform;
  transform.header = read_header(bytes);
  transform.child_frame_id = read_frame(bytes);
  transform.T_parent_child = read_transform(bytes);
  require(bytes.ok(), "it ends early");
  return transform;
}

}  // namespace

LaserScanMessage decode_laser_scan(std::string_view message) {
  ByteReader bytes(message);
  LaserScanMessage result{read_header(bytes), {}};
  LaserScan& scan = result.scan;
  scan.stamp = result.header.stamp;
  scan.angle_min_rad = bytes.number<float>();
  bytes.number<float>();  // angle_max follows from the others
  scan.angle_increment_rad = bytes.number<float>();
  bytes.take(2 * sizeof(float));  // time_increment, scan_time: motion within the sweep is not modelled
  scan.range_min_m = bytes.number<float>();
  scan.range_max_m = bytes.number<float>();
  scan.ranges_m = read_floats(bytes);
  bytes.take(bytes.number<std::uint32_t>() * sizeof(float));  // intensities
  require(bytes.ok(), "it ends early");
  ros::check_scan(scan);
  return result;
}

StampedTransform decode_odometry(std::string_view message) {
  ByteReader bytes(message);
  StampedTransform odometry = read_stamped_transform(bytes);
  bytes.take(sizeof(double) * (36 + 6 + 36));  // covariance of the pose, twist and its covariance
  require(bytes.ok(), "it ends early");
  require(odometry.T_parent_child.has_value(), "its pose is not finite, or its rotation is none");
  return odometry;
}

std::vector<StampedTransform> decode_transforms(std::string_view message) {
  constexpr std::size_t kLeastBytes = 12 + 4 + 4 + 7 * sizeof(double);
  ByteReader bytes(message);
  const std::size_t count = bytes.number<std::uint32_t>();
  require(bytes.ok() && count <= bytes.remaining() / kLeastBytes,
          "it announces more transforms than it holds");
  std::vector<StampedTransform> transforms;
  transforms.reserve(count);
  for (std::size_t i = 0; i < count; ++i) transforms.push_back(read_stamped_transform(bytes));
  return transforms;
}

}  // namespace cairn::ros1
