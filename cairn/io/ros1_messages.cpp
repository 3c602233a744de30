#include "cairn/io/ros1_messages.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/io/byte_reader.hpp"
#include "cairn/io/rosbag1_records.hpp"

#include <cmath>
#include <cstring>

namespace cairn::ros1 {
namespace {

constexpr double kMaxAngle = 2.0 * kTwoPi;
constexpr double kMaxCoordinate = 1e7;  // metres
constexpr double kMaxNormError = 0.01;  // of a quaternion; beyond it, it was no rotation

void require(bool condition, const char* otherwise) {
  if (!condition) throw MalformedMessage(otherwise);
}

std::string read_frame(ByteReader& bytes) {
  std::string_view name = bytes.block();
  if (name.starts_with('/')) name.remove_prefix(1);
  return std::string(name);
}

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

std::optional<RigidTransform> read_transform(ByteReader& bytes) {
  double v[7];
  for (double& value : v) value = bytes.number<double>();
  RigidTransform transform{{v[0], v[1], v[2]}, {v[6], v[3], v[4], v[5]}};  // Eigen takes w first
  const double norm = transform.rotation.norm();
  const bool is_near = transform.position.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kMaxCoordinate;
  if (!is_near || !(std::abs(norm - 1.0) <= kMaxNormError)) return std::nullopt;
  transform.rotation.coeffs() /= norm;
  return transform;
}

StampedTransform read_stamped_transform(ByteReader& bytes) {
  StampedTransform transform;
  transform.header = read_header(bytes);
  transform.child_frame_id = read_frame(bytes);
  transform.T_parent_child = read_transform(bytes);
  require(bytes.ok(), "it ends early");
  return transform;
}

void check_scan(const LaserScan& scan) {
  require(!scan.ranges_m.empty(), "a scan without beams");
  require(std::abs(scan.angle_min_rad) <= kMaxAngle, "angle_min is no angle in radians");
  require(std::abs(scan.angle_increment_rad) <= kMaxAngle, "angle_increment is no angle in radians");
  const double sweep = std::abs(scan.angle_increment_rad) * static_cast<double>(scan.ranges_m.size());
  require(sweep <= kMaxAngle, "its beams turn by more than two turns");
  require(scan.angle_increment_rad != 0.0 || scan.ranges_m.size() == 1, "angle_increment is zero");
  require(scan.range_min_m >= 0.0 && scan.range_max_m > scan.range_min_m,
          "range_min and range_max enclose nothing");
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
  check_scan(scan);
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

Pose2 planar(const RigidTransform& transform) {
  const Eigen::Vector3d forward = transform.rotation * Eigen::Vector3d::UnitX();
  return {transform.position.x(), transform.position.y(),
          normalize_angle(std::atan2(forward.y(), forward.x()))};
}

RigidTransform operator*(const RigidTransform& T_a_b, const RigidTransform& T_b_c) {
  return {T_a_b.position + T_a_b.rotation * T_b_c.position, T_a_b.rotation * T_b_c.rotation};
}

RigidTransform inverse(const RigidTransform& T_a_b) {
  const Eigen::Quaterniond rotation = T_a_b.rotation.conjugate();
  return {-(rotation * T_a_b.position), rotation};
}

}  // namespace cairn::ros1
