#pragma once

#include "cairn/io/ros_log.hpp"

#include <string_view>

namespace cairn::ros2 {

/// Decodes the messages of a ROS 2 bag for a RosLog: sensor_msgs/msg/LaserScan, nav_msgs/msg/Odometry and
/// tf2_msgs/msg/TFMessage, as CDR; all else is counted. A message that rosbag2 packed with zstd one by one
/// (compression mode MESSAGE) is unpacked first.
class Ros2Log : public ros::RosLog {
 public:
  using RosLog::RosLog;

  /// @param encoding  "cdr"; a message in any other is counted as "unsupported message (TYPE as ...)"
  void add(const ros::Message& message, std::string_view encoding);
};

}  // namespace cairn::ros2
