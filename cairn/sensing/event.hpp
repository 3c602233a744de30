#pragma once

#include "cairn/core/time.hpp"
#include "cairn/sensing/laser_scan.hpp"
#include "cairn/sensing/odometry.hpp"

#include <cstdint>
#include <memory>
#include <variant>

namespace cairn {

/// Index into the stream table of whatever produced the event (a log, a robot).
using StreamId = std::uint16_t;

/// What a sensor said, when, and on which stream: the only input of a localizer.
/// Scans are shared, not copied: an event is cheap to queue, to keep and to replay.
struct Event {
  using Payload = std::variant<Odometry, std::shared_ptr<const LaserScan>>;

  Time stamp;    ///< when it was measured
  Time arrival;  ///< when it became known; equal to `stamp` where the log does not say
  StreamId stream = 0;
  Payload payload;
};

}  // namespace cairn
