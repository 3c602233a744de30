#pragma once

#include "apps/cairn/commands.hpp"

namespace cairn::app {

/// `cairn tune odometry`: the errors of the wheels, for the filter and for the simulator.
void add_tune_odometry(CLI::App& tune, Runner& run);

}  // namespace cairn::app
