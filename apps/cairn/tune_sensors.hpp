#pragma once

#include "apps/cairn/commands.hpp"

namespace cairn::app {

/// `cairn tune laser` and `cairn tune uwb`: the noise of these sensors, for world files of `cairn simulate`.
void add_tune_laser(CLI::App& tune, Runner& run);
void add_tune_uwb(CLI::App& tune, Runner& run);

}  // namespace cairn::app
