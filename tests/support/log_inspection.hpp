#pragma once

#include "cairn/io/log.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <string>

namespace cairn::test {

inline const LaserScan& scan_of(const Event& event) {
  return *std::get<std::shared_ptr<const LaserScan>>(event.payload);
}

inline Pose2 pose_of(const Event& event) { return std::get<Odometry>(event.payload).T_odom_base; }

inline bool is_scan(const Event& event) {
  return std::holds_alternative<std::shared_ptr<const LaserScan>>(event.payload);
}

/// How often the reader counted `kind`.
inline std::int64_t count(const Log& log, const std::string& kind) {
  const auto entry = log.diagnostics.counts().find(kind);
  return entry == log.diagnostics.counts().end() ? 0 : entry->second;
}

/// The first thing that the reader said, or "".
inline std::string first_example(const Log& log) {
  return log.diagnostics.examples().empty() ? "" : log.diagnostics.examples().front().text;
}

inline std::map<std::string, std::size_t> messages_by_stream(const Log& log) {
  std::map<std::string, std::size_t> counts;
  for (const Event& event : log.events) ++counts[log.streams.at(event.stream).name];
  return counts;
}

}  // namespace cairn::test
