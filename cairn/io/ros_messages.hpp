#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/core/time.hpp"
#include "cairn/sensing/laser_scan.hpp"

#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include <Eigen/Geometry>

/// What the messages of ROS 1 and ROS 2 have in common, however they are serialised.
namespace cairn::ros {

/// Bytes that are no such message. The text says what is wrong with them.
struct MalformedMessage : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// @throws MalformedMessage(otherwise) unless the condition holds
inline void require(bool condition, const char* otherwise) {
  if (!condition) throw MalformedMessage(otherwise);
}

struct Header {
  Time stamp;            ///< zero where the sender set none
  std::string frame_id;  ///< without the leading '/' that old tf wrote
};

/// sensor_msgs/LaserScan. Ranges as recorded (0, inf, NaN: no return), intensities skipped.
struct LaserScanMessage {
  Header header;
  LaserScan scan;  ///< its stamp is the header's
};

/// A position and a unit quaternion.
struct RigidTransform {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

/// nav_msgs/Odometry, without covariances and twist: header.frame_id is `odom`, child_frame_id the base.
/// Also one element of tf2_msgs/TFMessage (geometry_msgs/TransformStamped).
struct StampedTransform {
  Header header;
  std::string child_frame_id;
  std::optional<RigidTransform> T_parent_child;  ///< nullopt: not finite, over 10,000 km, or no rotation
};

/// Name of a frame as it is kept: without the leading '/'.
std::string frame_name(std::string_view name);

/// From x y z and quaternion x y z w, as they stand in messages; normalised. nullopt: see StampedTransform.
std::optional<RigidTransform> rigid_transform(const std::array<double, 7>& values);

/// @throws MalformedMessage for a scan without sense: no beam, angles or limits not finite, |angle| beyond
///   two turns (degrees?), range_max <= range_min.
void check_scan(const LaserScan& scan);

/// Planar part: x, y and yaw (rotation about the parent's z axis, from where x points).
Pose2 planar(const RigidTransform& transform);

RigidTransform operator*(const RigidTransform& T_a_b, const RigidTransform& T_b_c);
RigidTransform inverse(const RigidTransform& T_a_b);

}  // namespace cairn::ros
