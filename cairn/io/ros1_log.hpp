#pragma once

#include "cairn/io/ros_log.hpp"

#include <string>
#include <string_view>

namespace cairn::ros1 {

/// Decodes the messages of a ROS 1 bag for a RosLog: sensor_msgs/LaserScan, nav_msgs/Odometry,
/// tf2_msgs/TFMessage and tf/tfMessage, in the one version that each of them has had; all else is counted.
class Ros1Log : public ros::RosLog {
 public:
  using RosLog::RosLog;

  /// @param md5sum  of the message's definition: the version of its type
  void add(const ros::Message& message, std::string_view md5sum);
};

}  // namespace cairn::ros1
