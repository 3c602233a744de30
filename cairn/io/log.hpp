#pragma once

#include "cairn/core/diagnostics.hpp"
#include "cairn/sensing/event.hpp"
#include "cairn/sensing/stream_info.hpp"

#include <string>
#include <vector>

namespace cairn {

/// A recording, read whole. Events stand in the order of the file (the order of arrival), which need not be
/// the order of their stamps.
struct Log {
  std::string format;  ///< "carmen", "wean", "rosbag1", "rosbag2_db3", "mcap", "cairn_mcap", "mrpt_text"
  std::vector<StreamInfo> streams;
  std::vector<Event> events;
  Diagnostics diagnostics;  ///< what was skipped or repaired while reading, counted
};

/// Puts the events in the order of their stamps (stable). Returns how many adjacent pairs ran backwards.
std::size_t sort_by_stamp(Log& log);

}  // namespace cairn
