#pragma once

#include <string>
#include <string_view>

namespace cairn::ros2 {

inline constexpr std::string_view kLaserScan = "sensor_msgs/msg/LaserScan";
inline constexpr std::string_view kOdometry = "nav_msgs/msg/Odometry";
inline constexpr std::string_view kTransforms = "tf2_msgs/msg/TFMessage";
inline constexpr std::string_view kRange = "sensor_msgs/msg/Range";
inline constexpr std::string_view kImage = "sensor_msgs/msg/Image";
inline constexpr std::string_view kCameraInfo = "sensor_msgs/msg/CameraInfo";
inline constexpr std::string_view kImu = "sensor_msgs/msg/Imu";
inline constexpr std::string_view kPose = "geometry_msgs/msg/PoseWithCovarianceStamped";

/// Definition of a message in the form "ros2msg" of MCAP (https://mcap.dev/spec/registry): its fields, then
/// those of every message that it is made of, each after a line of 80 '=' and a line "MSG: package/Type".
/// @param type  one of the names above
std::string schema(std::string_view type);

}  // namespace cairn::ros2
