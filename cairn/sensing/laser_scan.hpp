#pragma once

#include "cairn/core/time.hpp"

#include <vector>

namespace cairn {

/// One sweep of a planar laser scanner, beams counter-clockwise in the sensor's frame (x forward, y left).
///
/// Beam i looks at `angle_min_rad + i * angle_increment_rad` (the increment may be negative) and measured
/// `ranges_m[i]` metres. A beam is *valid* if its range is finite and lies in [range_min_m, range_max_m);
/// NaN, infinite, zero, and out-of-bounds ranges mean "no return" and are kept so that indices hold.
struct LaserScan {
  Time stamp;  ///< of the sweep; motion within the sweep is not modelled yet
  double angle_min_rad = 0.0;
  double angle_increment_rad = 0.0;
  double range_min_m = 0.0;
  double range_max_m = 0.0;
  std::vector<float> ranges_m;

  bool is_valid_range(float range_m) const {
    return range_m > 0.0f && range_m >= range_min_m && range_m < range_max_m;
  }
};

}  // namespace cairn
