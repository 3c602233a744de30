#pragma once

#include "cairn/core/options.hpp"

#include <string>

namespace cairn {

/// How a localizer deals with data that comes late, or not at all.
struct TimeOptions {
  /// What becomes of a measurement that is older than the belief:
  ///   replay  it is put at its true time, and what followed is applied again
  ///   delay   none comes so late: all streams wait for the most delayed one (MuSe, section III-D)
  ///   drop    it is lost
  std::string late_policy = "replay";
  double history_s = 2.0;      ///< how far back late_policy replay reaches
  double lag_memory_s = 10.0;  ///< for how long a lag that was seen counts
  double odometry_timeout_s =
      1.0;                        ///< after this silence of the odometry, measurements no longer wait for it
  double watchdog_factor = 10.0;  ///< a stream is silent after so many of its periods; 0: never

  void visit(OptionVisitor& visitor);
};

}  // namespace cairn
