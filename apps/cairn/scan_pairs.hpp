#pragma once

#include "cairn/core/trajectory.hpp"
#include "cairn/io/log.hpp"

#include <vector>

namespace cairn::app {

/// How scans differ from the scans before them, metres.
struct ScanPairs {
  /// End points of a scan, moved by the odometry into the frame of the scan before: their range minus that of
  /// the surface which two neighbouring beams saw there. Surfaces seen at a slant (neighbours more than 20 cm
  /// apart) are left out.
  std::vector<double> moving;
  /// The same beam of both scans, while the odometry stood still.
  std::vector<double> standing;
};

/// @param laser     stream of the scans
/// @param odometry  T_odom_base, in the order of the stamps
ScanPairs pair_scans(const Log& log, StreamId laser, const Trajectory& odometry, const Pose2& T_base_laser);

}  // namespace cairn::app
