#pragma once

#include "cairn/core/pose2.hpp"

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

namespace cairn {

/// What a stream tells, in the order of Event::Payload. Logs hold the names: only ever append.
enum class StreamKind : std::uint8_t {
  kOdometry,
  kLaserScan,
  kSonarScan,
  kDepthImage,
  kWifiScan,
  kBeaconRanges,
  kLandmarkDetections,
  kCeilingPatch,
  kImuYawRate
};

inline constexpr std::string_view kStreamKindNames[] = {
    "odometry",      "laser_scan",          "sonar_scan",    "depth_image", "wifi_scan",
    "beacon_ranges", "landmark_detections", "ceiling_patch", "imu_yaw_rate"};
inline constexpr std::size_t kStreamKinds = std::size(kStreamKindNames);

/// "odometry", "laser_scan", ...
constexpr std::string_view name_of(StreamKind kind) {
  return kStreamKindNames[static_cast<std::size_t>(kind)];
}

/// The kind of that name; nullopt for others.
constexpr std::optional<StreamKind> stream_kind_named(std::string_view name) {
  for (std::size_t i = 0; i < kStreamKinds; ++i) {
    if (kStreamKindNames[i] == name) return static_cast<StreamKind>(i);
  }
  return std::nullopt;
}

/// One sensor of a log or a robot. `Event::stream` is its index in the table of streams.
struct StreamInfo {
  std::string name;  ///< topic, or the reader's name for the message ("odom", "flaser", ...)
  StreamKind kind = StreamKind::kOdometry;
  std::string frame;                   ///< frame_id where the log names one
  std::optional<Pose2> T_base_sensor;  ///< mounting pose where the log tells it (PARAM, tf)
};

}  // namespace cairn
