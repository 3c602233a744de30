#pragma once

#include "cairn/core/pose2.hpp"

#include <optional>
#include <string>

namespace cairn {

enum class StreamKind { kOdometry, kLaserScan };

/// One sensor of a log or a robot. `Event::stream` is its index in the table of streams.
struct StreamInfo {
  std::string name;  ///< topic, or the reader's name for the message ("odom", "flaser", ...)
  StreamKind kind = StreamKind::kOdometry;
  std::string frame;                   ///< frame_id where the log names one
  std::optional<Pose2> T_base_sensor;  ///< mounting pose where the log tells it (PARAM, tf)
};

}  // namespace cairn
