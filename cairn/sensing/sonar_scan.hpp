#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/core/time.hpp"

#include <vector>

namespace cairn {

/// One round of a ring of sonar transducers.
///
/// Transducer i stands at `T_sensor_transducer[i]` in the sensor's frame (x forward, y left) and looks along
/// its own x axis. `ranges_m[i]` is the distance to whatever first sent an echo back from anywhere in its
/// cone: a range tells a region, not a point, and a smooth wall that is hit aslant sends none. A range is
/// *valid* if it is finite and lies in [range_min_m, range_max_m); all else means "no echo" and is kept so
/// that indices hold.
struct SonarScan {
  Time stamp;  ///< of the round: all transducers at once
  double range_min_m = 0.0;
  double range_max_m = 0.0;
  double cone_rad = 0.0;  ///< full opening angle, (0, pi]
  std::vector<Pose2> T_sensor_transducer;
  std::vector<float> ranges_m;  ///< as many as transducers

  bool is_valid_range(float range_m) const {
    return range_m > 0.0f && range_m >= range_min_m && range_m < range_max_m;
  }
};

}  // namespace cairn
