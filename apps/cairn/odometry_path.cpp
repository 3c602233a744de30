#include "apps/cairn/odometry_path.hpp"

#include "cairn/core/errors.hpp"

namespace cairn::app {
namespace {

StreamId odometry_stream(const Log& log, const std::string& name) {
  std::string names;
  for (std::size_t i = 0; i < log.streams.size(); ++i) {
    const StreamInfo& stream = log.streams[i];
    if (stream.kind != StreamKind::kOdometry) continue;
    if (name.empty() || stream.name == name) return static_cast<StreamId>(i);
    names += (names.empty() ? "" : ", ") + stream.name;
  }
  if (names.empty()) throw InputError("log", "holds no odometry", "name a log that does");
  throw ConfigurationError("--stream", "the log has no odometry '" + name + "'", "name one of: " + names);
}

}  // namespace

Trajectory odometry_path(const Log& log, const std::string& name) {
  const StreamId stream = odometry_stream(log, name);
  Trajectory path;
  for (const Event& event : log.events) {
    if (event.stream == stream) path.push_back({event.stamp, std::get<Odometry>(event.payload).T_odom_base});
  }
  sort_by_stamp(path);
  return path;
}

}  // namespace cairn::app
