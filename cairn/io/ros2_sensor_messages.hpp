#pragma once

#include "cairn/io/ros_messages.hpp"
#include "cairn/sensing/ceiling_patch.hpp"
#include "cairn/sensing/depth_image.hpp"
#include "cairn/sensing/imu_yaw_rate.hpp"
#include "cairn/sensing/sonar_scan.hpp"

#include <cstddef>
#include <string>

/// ROS 2 messages for what sensors other than lasers say, as CDR: written for other tools, never read back.
namespace cairn::ros2 {

/// sensor_msgs/Range of one transducer: ultrasound; +inf for no echo (REP 117).
std::string encode_range(const ros::Header& header, const SonarScan& scan, std::size_t transducer);
/// sensor_msgs/Image, "16UC1" (mm) or "32FC1" (m), as REP 118 tells depth images.
std::string encode_image(const ros::Header& header, const DepthImage& image);
/// sensor_msgs/CameraInfo of a camera without distortion.
std::string encode_camera_info(const ros::Header& header, const DepthImage& image);
/// sensor_msgs/Image, "mono8".
std::string encode_image(const ros::Header& header, const CeilingPatch& patch);
/// sensor_msgs/Imu: only the rate about z; orientation and acceleration are marked as unknown.
std::string encode_imu(const ros::Header& header, const ImuYawRate& rate);

}  // namespace cairn::ros2
