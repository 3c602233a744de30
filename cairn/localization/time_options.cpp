#include "cairn/localization/time_options.hpp"

namespace cairn {

void TimeOptions::visit(OptionVisitor& v) {
  v.choice({"late_policy",
            "what becomes of a measurement that is older than the belief: replay (put at its true time, what "
            "followed is applied again), delay (all streams wait for the most delayed one) or drop"},
           late_policy, {"replay", "delay", "drop"});
  v.number({"history_s", "how far back late_policy replay reaches, seconds"}, history_s, {0.01, 60.0});
  v.number({"lag_memory_s", "for how long a lag that was seen counts, seconds"}, lag_memory_s, {0.1, 1e4});
  v.number({"odometry_timeout_s",
            "after this silence of the odometry, measurements no longer wait for it, seconds"},
           odometry_timeout_s, {0.01, 1e4});
  v.number({"watchdog_factor", "a stream counts as silent after so many of its periods; 0: never"},
           watchdog_factor, {0.0, 1e4});
}

}  // namespace cairn
