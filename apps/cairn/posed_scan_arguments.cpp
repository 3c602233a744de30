#include "apps/cairn/posed_scan_arguments.hpp"

#include "apps/cairn/pose_option.hpp"
#include "cairn/core/errors.hpp"

namespace cairn::app {

PosedScanOptions PosedScanArguments::options() const {
  PosedScanOptions options;
  options.stream = stream;
  options.max_gap_s = max_gap_s;
  if (!mount.empty()) options.T_base_sensor = parse_pose("--mount", mount);
  if (frame != "base" && frame != "sensor") {
    throw ConfigurationError("--trajectory-frame", "'" + frame + "' is not known", "use base or sensor");
  }
  options.trajectory_is_of_sensor = frame == "sensor";
  return options;
}

void add_posed_scan_options(CLI::App& command, PosedScanArguments& a) {
  command.add_option("--stream", a.stream, "Laser stream, where the log has several");
  command.add_option("--mount", a.mount,
                     "x,y,yaw (m, rad) of the laser on the robot, where the log tells none");
  command.add_option("--trajectory-frame", a.frame, "Whose poses the trajectory holds: base or sensor")
      ->capture_default_str();
  command.add_option("--max-gap-s", a.max_gap_s, "Do not interpolate between poses further apart, s")
      ->capture_default_str();
}

}  // namespace cairn::app
