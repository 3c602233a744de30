#include "apps/cairn/pose_option.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/pose_collector.hpp"

#include <sstream>

namespace cairn::app {

Pose2 parse_pose(const std::string& option, const std::string& text) {
  try {
    std::istringstream input(text);
    LineReader lines(input, option);
    lines.next();
    FieldReader fields(lines, " \t,");
    const Pose2 pose = read_pose_fields(fields);
    expect_line_end(fields);
    return pose;
  } catch (const InputError&) {
    throw ConfigurationError(option, "'" + text + "' is not a pose",
                             "write x,y,yaw in metres and radians, for example 0.08,0,0");
  }
}

}  // namespace cairn::app
