#pragma once

#include "cairn/core/time.hpp"
#include "cairn/sensing/beacon_ranges.hpp"
#include "cairn/sensing/ceiling_patch.hpp"
#include "cairn/sensing/depth_image.hpp"
#include "cairn/sensing/imu_yaw_rate.hpp"
#include "cairn/sensing/landmark_detections.hpp"
#include "cairn/sensing/laser_scan.hpp"
#include "cairn/sensing/odometry.hpp"
#include "cairn/sensing/sonar_scan.hpp"
#include "cairn/sensing/stream_info.hpp"
#include "cairn/sensing/wifi_scan.hpp"

#include <cstdint>
#include <memory>
#include <variant>

namespace cairn {

/// Index into the stream table of whatever produced the event (a log, a robot).
using StreamId = std::uint16_t;

/// What a sensor said, when, and on which stream: the only input of a localizer.
/// What is large is shared, not copied: an event is cheap to queue, to keep and to replay.
struct Event {
  /// In the order of StreamKind.
  using Payload = std::variant<Odometry, std::shared_ptr<const LaserScan>, std::shared_ptr<const SonarScan>,
                               std::shared_ptr<const DepthImage>, std::shared_ptr<const WifiScan>,
                               std::shared_ptr<const BeaconRanges>, std::shared_ptr<const LandmarkDetections>,
                               std::shared_ptr<const CeilingPatch>, ImuYawRate>;
  static_assert(std::variant_size_v<Payload> == kStreamKinds);

  Time stamp;    ///< when it was measured
  Time arrival;  ///< when it became known; equal to `stamp` where the log does not say
  StreamId stream = 0;
  Payload payload;
};

/// The kind of stream that such an event belongs to.
inline StreamKind kind_of(const Event& event) { return static_cast<StreamKind>(event.payload.index()); }

/// What the payload holds, by its own type: `visit_payload(event, [](const auto& measurement) { ... })`. A
/// null pointer is not visited.
/// @return false for a null pointer
template <class Visit>
bool visit_payload(const Event& event, const Visit& visit) {
  return std::visit(
      [&visit](const auto& payload) {
        if constexpr (requires { *payload; }) {
          if (!payload) return false;
          visit(*payload);
        } else {
          visit(payload);
        }
        return true;
      },
      event.payload);
}

}  // namespace cairn
