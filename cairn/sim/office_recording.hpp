#pragma once

#include "cairn/core/trajectory.hpp"
#include "cairn/maps/occupancy_grid.hpp"
#include "cairn/sensing/event.hpp"
#include "cairn/sensing/stream_info.hpp"
#include "cairn/sim/laser_scanner.hpp"
#include "cairn/sim/office_world.hpp"
#include "cairn/sim/tour_driver.hpp"
#include "cairn/sim/wheel_odometry.hpp"

#include <cstdint>
#include <vector>

namespace cairn {

struct OfficeRecordingOptions {
  OfficeOptions office;
  DriveLimits drive;
  WheelOdometryOptions odometry;
  LaserScannerOptions laser;
  Pose2 T_base_laser{0.2, 0.0, 0.0};
  int scan_every = 5;  ///< poses of the true trajectory per scan: 10 Hz
  double map_resolution_m = 0.05;
  Duration duration = Duration::zero();  ///< zero: once through all rooms
};

/// What a robot's drive through the office leaves behind, and what is true.
struct OfficeRecording {
  std::vector<StreamInfo> streams;  ///< 0: "odom", 1: "laser"
  std::vector<Event> events;        ///< in the order of their stamps; arrival is the stamp
  Trajectory truth;                 ///< T_map_base, exact, 50 Hz
  OccupancyGrid map;                ///< walls and furniture, not the people
  OfficeWorld world;
};

/// Simulates the whole recording. The same options and seed give the same bytes.
/// @throws ConfigurationError for options out of range
OfficeRecording record_office(const OfficeRecordingOptions& options, std::uint64_t seed);

}  // namespace cairn
