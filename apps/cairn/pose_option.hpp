#pragma once

#include "cairn/core/pose2.hpp"

#include <string>

namespace cairn::app {

/// "x,y,yaw" (m, m, rad) of a command line.
/// @param option  its name, for the message
/// @throws ConfigurationError unless these are three finite numbers separated by commas
Pose2 parse_pose(const std::string& option, const std::string& text);

}  // namespace cairn::app
