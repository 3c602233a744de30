#include "cairn/io/ros_messages.hpp"

#include "cairn/core/angle.hpp"

#include <cmath>

namespace cairn::ros {
namespace {

constexpr double kMaxAngle = 2.0 * kTwoPi;
constexpr double kMaxCoordinate = 1e7;  // metres
constexpr double kMaxNormError = 0.01;  // of a quaternion; beyond it, it was no rotation

}  // namespace

std::string frame_name(std::string_view name) {
  if (name.starts_with('/')) name.remove_prefix(1);
  return std::string(name);
}

std::optional<RigidTransform> rigid_transform(const std::array<double, 7>& v) {
  RigidTransform transform{{v[0], v[1], v[2]}, {v[6], v[3], v[4], v[5]}};  // Eigen takes w first
  const double norm = transform.rotation.norm();
  const bool is_near = transform.position.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kMaxCoordinate;
  if (!is_near || !(std::abs(norm - 1.0) <= kMaxNormError)) return std::nullopt;
  transform.rotation.coeffs() /= norm;
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

}  // namespace cairn::ros
