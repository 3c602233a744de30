#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cairn/core/diagnostics.hpp"
#include "cairn/core/pose2.hpp"
#include "cairn/sensing/event.hpp"

namespace cairn {

enum class StreamKind { kOdometry, kLaserScan };

/// One sensor of a log. `Event::stream` is its index in `Log::streams`.
struct StreamInfo {
  std::string name;  ///< topic, or the reader's name for the message ("odom", "flaser", ...)
  StreamKind kind = StreamKind::kOdometry;
  std::string frame;                        ///< frame_id where the log names one
  std::optional<Pose2> T_base_sensor;       ///< mounting pose where the log tells it (PARAM, tf)
};

/// A recording, read whole. Events stand in the order of the file (the order of arrival), which need not be
/// the order of their stamps.
struct Log {
  std::string format;  ///< "carmen", "wean", "rosbag1", "mrpt_text"
  std::vector<StreamInfo> streams;
  std::vector<Event> events;
  Diagnostics diagnostics;  ///< what was skipped or repaired while reading, counted
};

/// Puts the events in the order of their stamps (stable). Returns how many adjacent pairs ran backwards.
std::size_t sort_by_stamp(Log& log);

}  // namespace cairn
