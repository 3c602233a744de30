#include "apps/cairn/posed_scans.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>

namespace cairn::app {
namespace {

std::string names_of_lasers(const Log& log) {
  std::string names;
  for (const StreamInfo& stream : log.streams) {
    if (stream.kind != StreamKind::kLaserScan) continue;
    if (!names.empty()) names += ", ";
    names += stream.name;
  }
  return names;
}

Pose2 trajectory_to_sensor(const StreamInfo& stream, const PosedScanOptions& options) {
  if (options.trajectory_is_of_sensor) return {};
  if (options.T_base_sensor) return *options.T_base_sensor;
  if (stream.T_base_sensor) return *stream.T_base_sensor;
  throw ConfigurationError("--mount", "the log does not tell where " + stream.name + " sits on the robot",
                           "give --mount x,y,yaw, or --trajectory-frame sensor if the path is the laser's");
}

}  // namespace

StreamId laser_stream(const Log& log, const std::string& name) {
  const std::string lasers = names_of_lasers(log);
  if (lasers.empty()) throw InputError("log", "holds no laser scans", "name a log that does");
  std::optional<StreamId> found;
  for (std::size_t i = 0; i < log.streams.size(); ++i) {
    const StreamInfo& stream = log.streams[i];
    if (stream.kind != StreamKind::kLaserScan || (!name.empty() && stream.name != name)) continue;
    if (found) throw ConfigurationError("--stream", "the log has several lasers", "name one of: " + lasers);
    found = static_cast<StreamId>(i);
  }
  if (!found)
    throw ConfigurationError("--stream", "the log has no laser '" + name + "'", "name one of: " + lasers);
  return *found;
}

std::optional<Pose2> pose_without_gap(const Trajectory& path, Time stamp, Duration max_gap) {
  const auto after = std::lower_bound(path.begin(), path.end(), stamp,
                                      [](const StampedPose& p, Time t) { return p.stamp < t; });
  const bool is_between = after != path.end() && after->stamp != stamp && after != path.begin();
  if (is_between && after->stamp - (after - 1)->stamp > max_gap) return std::nullopt;
  return pose_at(path, stamp);
}

PosedScans pose_scans(const Log& log, const Trajectory& trajectory, const PosedScanOptions& options) {
  if (!(options.max_gap_s >= 0.0 && options.max_gap_s < 1e9)) {
    throw ConfigurationError("--max-gap-s", "is out of range", "give seconds, 0 or more");
  }
  const StreamId stream = laser_stream(log, options.stream);
  const Pose2 T_path_sensor = trajectory_to_sensor(log.streams[stream], options);
  const Duration max_gap = duration_from_seconds(options.max_gap_s);
  PosedScans posed;
  for (const Event& event : log.events) {
    if (event.stream != stream) continue;
    const auto pose = pose_without_gap(trajectory, event.stamp, max_gap);
    if (!pose) ++posed.without_pose;
    if (!pose) continue;
    posed.scans.push_back({*pose * T_path_sensor, std::get<std::shared_ptr<const LaserScan>>(event.payload)});
  }
  return posed;
}

}  // namespace cairn::app
