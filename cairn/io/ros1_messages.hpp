#pragma once

#include "cairn/io/ros_messages.hpp"

#include <string_view>
#include <vector>

/// The ROS 1 messages that Cairn understands, from their serialised bytes (little-endian, packed).
namespace cairn::ros1 {

/// @throws MalformedMessage if the bytes end early, announce more than they hold, or the scan makes no sense
///   (ros::check_scan)
ros::LaserScanMessage decode_laser_scan(std::string_view bytes);
/// @throws MalformedMessage if the bytes end early or the pose is no pose.
ros::StampedTransform decode_odometry(std::string_view bytes);
/// tf2_msgs/TFMessage and tf/tfMessage. @throws MalformedMessage if the bytes end early.
std::vector<ros::StampedTransform> decode_transforms(std::string_view bytes);

}  // namespace cairn::ros1
