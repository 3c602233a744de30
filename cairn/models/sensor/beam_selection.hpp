#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/sensing/laser_scan.hpp"

#include <cstddef>
#include <vector>

namespace cairn {

/// Ranges that a model may use, within the scan's own limits, metres.
struct BeamLimits {
  double min_range_m = 0.0;
  double max_range_m = 1e9;
};

/// Indices of at most `max_beams` (0: all) of the valid beams of a scan, in their order. Invalid beams are
/// dropped *before* the choice, which is then even over the valid ones: choosing first and dropping later
/// leaves few beams in scans with many missing returns.
std::vector<std::size_t> select_beams(const LaserScan& scan, const BeamLimits& limits, int max_beams);

/// Their end points, in the robot's base frame.
std::vector<Point2> select_end_points(const LaserScan& scan, const Pose2& T_base_sensor,
                                      const BeamLimits& limits, int max_beams);

/// What one beam says: a range, or that there is nothing within reach.
struct BeamReading {
  double bearing_rad = 0.0;  ///< in the sensor's frame
  double range_m = 0.0;      ///< reach_m() for a beam without return
  bool is_return = true;
};

/// From here on a range means "no return", metres.
double reach_m(const LaserScan& scan, const BeamLimits& limits);

/// At most `max_beams` (0: all) of the beams that say something: those with a valid range, and those without
/// return (infinite, or reach_m() and more). NaN, zero and ranges below the least one say nothing.
std::vector<BeamReading> select_readings(const LaserScan& scan, const BeamLimits& limits, int max_beams);

}  // namespace cairn
