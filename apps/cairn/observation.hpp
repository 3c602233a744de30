#pragma once

#include "cairn/io/log.hpp"
#include "cairn/localization/localizer_options.hpp"

#include <string>
#include <vector>

namespace cairn::app {

/// What a robot saw at one time: end points of beams in its base frame, of one scan or of several joined by
/// odometry.
struct Observation {
  Time stamp;
  std::vector<Point2> points;
  int scans = 0;
  double path_m = 0.0;  ///< driven between the first scan and the last
};

struct ObservationRequest {
  std::string stream;   ///< laser; may be empty if the log has one in use only
  double at_s = 0.0;    ///< the last scan is the first one this long after the log's first scan
  double path_m = 0.0;  ///< scans of the last metres driven are joined; 0: one scan
};

/// Scans are joined every half metre or half radian, each seen from the robot at the last one.
/// @throws ConfigurationError if the log has no such scan, stream, mount or (to join scans) odometry
Observation observe(const Log& log, const LocalizerOptions& options, const ObservationRequest& request);

}  // namespace cairn::app
