#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/core/time.hpp"
#include "cairn/sensing/laser_scan.hpp"

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

/// The ROS 1 messages that Cairn understands, from their serialised bytes (little-endian, packed).
namespace cairn::ros1 {

/// Bytes that are no such message. The text says what is wrong with them.
struct MalformedMessage : std::runtime_error {
  using std::runtime_error::runtime_error;
};

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

/// @throws MalformedMessage if the bytes end early, announce more than they hold, or the scan makes no sense:
///   no beam, angles or limits not finite, |angle| beyond two turns (degrees?), range_max <= range_min.
LaserScanMessage decode_laser_scan(std::string_view bytes);
/// @throws MalformedMessage if the bytes end early or the pose is no pose.
StampedTransform decode_odometry(std::string_view bytes);
/// tf2_msgs/TFMessage and tf/tfMessage. @throws MalformedMessage if the bytes end early.
std::vector<StampedTransform> decode_transforms(std::string_view bytes);

/// Planar part: x, y and yaw (rotation about the parent's z axis, from where x points).
Pose2 planar(const RigidTransform& transform);

RigidTransform operator*(const RigidTransform& T_a_b, const RigidTransform& T_b_c);
RigidTransform inverse(const RigidTransform& T_a_b);

}  // namespace cairn::ros1
