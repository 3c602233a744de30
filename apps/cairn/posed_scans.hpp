#pragma once

#include "cairn/core/trajectory.hpp"
#include "cairn/io/log.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cairn::app {

/// How the scans of a log and the path of its robot belong together.
struct PosedScanOptions {
  std::string stream;                    ///< of the scans; may be empty if the log has one laser stream only
  std::optional<Pose2> T_base_sensor;    ///< mounting pose; none: as the log tells it
  bool trajectory_is_of_sensor = false;  ///< else it is of the base
  /// Poses are interpolated at the scans' stamps, but not between poses further apart than this.
  double max_gap_s = 1.0;
};

struct PosedScan {
  Pose2 T_map_sensor;
  std::shared_ptr<const LaserScan> scan;
};

struct PosedScans {
  std::vector<PosedScan> scans;  ///< in the order of the log
  std::size_t without_pose = 0;  ///< outside the trajectory or in one of its gaps
};

/// Index of the laser stream named `name`, or of the only one if `name` is empty.
/// @throws ConfigurationError naming the streams there are; InputError if the log has no laser
StreamId laser_stream(const Log& log, const std::string& name);

/// As pose_at, but nothing between two poses that are too far apart in time.
std::optional<Pose2> pose_without_gap(const Trajectory& path, Time stamp, Duration max_gap);

/// The scans of one stream with the poses from which they were taken.
/// @throws ConfigurationError as laser_stream, if the mounting pose is needed and nobody tells it, and for a
///   gap out of range
PosedScans pose_scans(const Log& log, const Trajectory& trajectory, const PosedScanOptions& options);

}  // namespace cairn::app
