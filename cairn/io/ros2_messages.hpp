#pragma once

#include "cairn/io/cdr.hpp"
#include "cairn/io/ros_messages.hpp"

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

/// The ROS 2 messages that Cairn understands and writes, as CDR (cdr.hpp).
namespace cairn::ros2 {

/// @throws ros::MalformedMessage if the bytes are no plain CDR, end early, announce more than they hold, or
/// the
///   scan makes no sense (ros::check_scan)
ros::LaserScanMessage decode_laser_scan(std::string_view bytes);
/// @throws ros::MalformedMessage if the bytes end early or the pose is no pose
ros::StampedTransform decode_odometry(std::string_view bytes);
/// tf2_msgs/TFMessage. @throws ros::MalformedMessage if the bytes end early
std::vector<ros::StampedTransform> decode_transforms(std::string_view bytes);

/// Angles and limits are rounded to float32, as the message demands; ranges are kept to the bit. A stamp
/// before 1901 or after 2038 does not fit into a message: the nearest that does is written.
std::string encode_laser_scan(const ros::LaserScanMessage& message, cdr::ByteOrder = cdr::ByteOrder::kLittle);
/// Without T_parent_child: the identity. Covariances and twist are written as zero.
std::string encode_odometry(const ros::StampedTransform& odometry, cdr::ByteOrder = cdr::ByteOrder::kLittle);
std::string encode_transforms(const std::vector<ros::StampedTransform>& transforms,
                              cdr::ByteOrder = cdr::ByteOrder::kLittle);

/// A pose in the plane as geometry_msgs/PoseWithCovarianceStamped.
/// @param covariance  of (x, y, theta): m, rad; its entries go to x, y and the rotation about z
std::string encode_pose(const ros::Header& header, const Pose2& pose, const Eigen::Matrix3d& covariance);

/// std_msgs/Header, with which most messages begin. A stamp before 1901 or after 2038 is written as the
/// nearest that fits.
void put_header(cdr::Writer& fields, const ros::Header& header);

/// z = 0, turned about z by theta.
ros::RigidTransform rigid(const Pose2& pose);

}  // namespace cairn::ros2
