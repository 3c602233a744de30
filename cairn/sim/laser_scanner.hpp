#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/sensing/laser_scan.hpp"
#include "cairn/sim/floor_plan.hpp"

#include <cstdint>
#include <numbers>

namespace cairn {

/// A planar laser scanner. The defaults are those of a common indoor safety scanner.
struct LaserScannerOptions {
  double field_of_view_rad = 1.5 * std::numbers::pi;  ///< symmetric about the sensor's x axis
  int beams = 361;  ///< the first and the last lie on the edges of the field of view
  double range_min_m = 0.05;
  double range_max_m = 20.0;
  double sigma_range_m = 0.01;         ///< white noise of each range
  double dropout_probability = 0.005;  ///< of a beam that returns nothing, each for itself

  void validate() const;  ///< @throws ConfigurationError for values out of range
};

/// The scan that a scanner at `T_map_laser` takes at `stamp`. Its beams are measured all at once; a beam that
/// meets nothing before the maximum range, or drops out, tells the maximum range (no return).
/// @param index  of the scan within the recording: scans of different index have independent noise
LaserScan simulate_scan(const FloorPlan& plan, const Pose2& T_map_laser, Time stamp,
                        const LaserScannerOptions& options, std::uint64_t seed, std::uint64_t index);

}  // namespace cairn
