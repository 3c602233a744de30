#include "cairn/io/event_twin.hpp"

#include "cairn/io/ros2_messages.hpp"
#include "cairn/io/ros2_schemas.hpp"
#include "cairn/io/ros2_sensor_messages.hpp"

namespace cairn::ros2 {
namespace {

// In the order of StreamKind.
constexpr std::string_view kTwinTypes[kStreamKinds] = {kOdometry, kLaserScan, kRange, kImage, "",
                                                       "",        "",         kImage, kImu};

struct Encoder {
  ros::Header header;

  std::vector<std::string> operator()(const Odometry& odometry) const {
    return {encode_odometry({{header.stamp, "odom"}, "base_link", rigid(odometry.T_odom_base)})};
  }
  std::vector<std::string> operator()(const LaserScan& scan) const {
    return {encode_laser_scan({header, scan})};
  }
  std::vector<std::string> operator()(const SonarScan& scan) const {
    std::vector<std::string> messages;
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i)
      messages.push_back(encode_range({header.stamp, transducer_frame(header.frame_id, i)}, scan, i));
    return messages;
  }
  std::vector<std::string> operator()(const DepthImage& image) const { return {encode_image(header, image)}; }
  std::vector<std::string> operator()(const CeilingPatch& patch) const {
    return {encode_image(header, patch)};
  }
  std::vector<std::string> operator()(const ImuYawRate& rate) const { return {encode_imu(header, rate)}; }
  std::vector<std::string> operator()(const WifiScan&) const { return {}; }
  std::vector<std::string> operator()(const BeaconRanges&) const { return {}; }
  std::vector<std::string> operator()(const LandmarkDetections&) const { return {}; }
};

}  // namespace

std::string_view twin_type(StreamKind kind) { return kTwinTypes[static_cast<std::size_t>(kind)]; }

std::vector<std::string> twins(const Event& event, const std::string& frame) {
  std::vector<std::string> messages;
  visit_payload(event, [&](const auto& measurement) {
    messages = Encoder{{event.stamp, frame}}(measurement);
  });
  return messages;
}

std::string transducer_frame(const std::string& frame, std::size_t transducer) {
  return frame + "_" + std::to_string(transducer);
}

}  // namespace cairn::ros2
