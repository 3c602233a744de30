#pragma once

#include "cairn/core/angle.hpp"
#include "cairn/maps/occupancy_grid.hpp"
#include "cairn/sensing/event.hpp"
#include "cairn/sensing/stream_info.hpp"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace cairn::test {

/// A room of 8 x 6 m, cells of 10 cm, with two boxes in it so that no two places look the same.
inline OccupancyGrid small_room() {
  const GridGeometry geometry{80, 60, 0.1, {}};
  std::vector<OccupancyGrid::Cell> cells(geometry.size(), 0);
  for (int row = 0; row < 60; ++row) {
    for (int column = 0; column < 80; ++column) {
      const bool wall = row == 0 || row == 59 || column == 0 || column == 79;
      const bool box = column >= 50 && column < 60 && row >= 20 && row < 40;
      const bool corner = column < 12 && row >= 45;
      if (wall || box || corner) cells[geometry.index(column, row)] = 100;
    }
  }
  return {geometry, std::move(cells)};
}

inline Time at(double seconds) { return time_from_seconds(seconds); }

/// What a scanner at the robot's base sees all around, found by walking along each beam.
inline LaserScan scan_from(const OccupancyGrid& map, const Pose2& T_map_base, Time stamp, int beams = 72) {
  LaserScan scan{stamp, -kPi, kTwoPi / beams, 0.05, 20.0, {}};
  for (int i = 0; i < beams; ++i) {
    const double angle = T_map_base.theta + scan.angle_min_rad + i * scan.angle_increment_rad;
    double range = 0.0;
    const auto point = [&] {
      return Point2{T_map_base.x + range * std::cos(angle), T_map_base.y + range * std::sin(angle)};
    };
    while (range < 20.0 && map.state_at(point()) == CellState::kFree) range += 0.01;
    scan.ranges_m.push_back(static_cast<float>(range));
  }
  return scan;
}

/// Where a robot is that started at `start` and drives a circle of 1 m radius at 0.5 m/s.
inline Pose2 on_circle(const Pose2& start, double seconds) {
  return start * exp(Twist2{0.5 * seconds, 0.0, 0.5 * seconds});
}

inline Event odometry_event(double seconds, const Pose2& pose, StreamId stream = 0) {
  return {at(seconds), at(seconds), stream, Odometry{at(seconds), pose}};
}

inline Event scan_event(LaserScan scan, StreamId stream = 1) {
  const Time stamp = scan.stamp;
  return {stamp, stamp, stream, std::make_shared<const LaserScan>(std::move(scan))};
}

inline std::vector<StreamInfo> odometry_and_laser() {
  return {{"odom", StreamKind::kOdometry, "", {}}, {"laser", StreamKind::kLaserScan, "", Pose2{}}};
}

}  // namespace cairn::test
