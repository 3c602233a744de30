#include "apps/cairn/map_building.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>

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

Pose2 trajectory_to_sensor(const StreamInfo& stream, const MapBuildingOptions& options) {
  if (options.trajectory_is_of_sensor) return {};
  if (options.T_base_sensor) return *options.T_base_sensor;
  if (stream.T_base_sensor) return *stream.T_base_sensor;
  throw ConfigurationError("--mount", "the log does not tell where " + stream.name + " sits on the robot",
                           "give --mount x,y,yaw, or --trajectory-frame sensor if the path is the laser's");
}

/// As pose_at, but nothing between two poses that are too far apart in time.
std::optional<Pose2> pose_without_gap(const Trajectory& path, Time stamp, Duration max_gap) {
  const auto after = std::lower_bound(path.begin(), path.end(), stamp,
                                      [](const StampedPose& p, Time t) { return p.stamp < t; });
  const bool is_between = after != path.end() && after->stamp != stamp && after != path.begin();
  if (is_between && after->stamp - (after - 1)->stamp > max_gap) return std::nullopt;
  return pose_at(path, stamp);
}

std::vector<Point2> end_points(const LaserScan& scan) {
  std::vector<Point2> points;
  points.reserve(scan.ranges_m.size());
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range = scan.ranges_m[i];
    if (!scan.is_valid_range(scan.ranges_m[i])) continue;
    const double angle = scan.angle_min_rad + static_cast<double>(i) * scan.angle_increment_rad;
    points.push_back({range * std::cos(angle), range * std::sin(angle)});
  }
  return points;
}

struct Counts {
  std::size_t used = 0, without_pose = 0, without_return = 0;
};

Counts add_scans(const Log& log, StreamId stream, const Trajectory& trajectory,
                 const MapBuildingOptions& options, GridBuilder& builder,
                 const std::function<void(double)>& progress) {
  const Pose2 T_path_sensor = trajectory_to_sensor(log.streams[stream], options);
  const Duration max_gap = duration_from_seconds(options.max_gap_s);
  Counts counts;
  for (std::size_t i = 0; i < log.events.size(); ++i) {
    progress(static_cast<double>(i) / static_cast<double>(log.events.size()));
    const Event& event = log.events[i];
    if (event.stream != stream) continue;
    const auto pose = pose_without_gap(trajectory, event.stamp, max_gap);
    const auto points = end_points(*std::get<std::shared_ptr<const LaserScan>>(event.payload));
    if (!pose) ++counts.without_pose;
    if (pose && points.empty()) ++counts.without_return;
    if (!pose || points.empty()) continue;
    builder.add(*pose * T_path_sensor, points);
    ++counts.used;
  }
  progress(1.0);
  return counts;
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

std::vector<Time> stamps_of(const Log& log, StreamId stream) {
  std::vector<Time> stamps;
  for (const Event& event : log.events) {
    if (event.stream == stream) stamps.push_back(event.stamp);
  }
  return stamps;
}

BuiltMap build_map(const Log& log, const Trajectory& trajectory, const MapBuildingOptions& options,
                   const std::function<void(double)>& progress) {
  if (!(options.max_gap_s >= 0.0 && options.max_gap_s < 1e9)) {
    throw ConfigurationError("--max-gap-s", "is out of range", "give seconds, 0 or more");
  }
  GridBuilder builder(options.grid);
  const Counts counts =
      add_scans(log, laser_stream(log, options.stream), trajectory, options, builder, progress);
  if (counts.used == 0) {
    throw InputError("map", "no scan lies inside the trajectory",
                     "check that log and trajectory are of the same run and clock, and --max-gap-s");
  }
  return {builder.build(), counts.used, counts.without_pose, counts.without_return};
}

}  // namespace cairn::app
