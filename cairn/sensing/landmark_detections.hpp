#pragma once

#include "cairn/core/time.hpp"

#include <vector>

namespace cairn {

/// One landmark as it was seen, in the sensor's frame (x forward, y left).
struct LandmarkDetection {
  static constexpr int kUnknown = -1;

  int id = kUnknown;         ///< which it is said to be; may be wrong
  double range_m = 0.0;      ///< to the landmark
  double bearing_rad = 0.0;  ///< counter-clockwise from x, [-pi, pi)
  friend bool operator==(const LandmarkDetection&, const LandmarkDetection&) = default;
};

/// Everything that a detector of landmarks saw at one instant; empty if it saw none. What it could have seen
/// is told too, so that what is absent can be used.
struct LandmarkDetections {
  Time stamp;
  double range_max_m = 0.0;        ///< landmarks beyond are not seen
  double field_of_view_rad = 0.0;  ///< symmetric about x, (0, 2 pi]
  std::vector<LandmarkDetection> detections;
};

}  // namespace cairn
