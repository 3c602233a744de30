#pragma once

#include "cairn/core/trajectory.hpp"
#include "cairn/io/log.hpp"

#include <string>

namespace cairn::app {

/// T_odom_base as the odometry stream of that name tells it, or the first one if `name` is empty, in the
/// order of the stamps.
/// @throws ConfigurationError naming the streams there are; InputError if the log has no odometry
Trajectory odometry_path(const Log& log, const std::string& name);

}  // namespace cairn::app
