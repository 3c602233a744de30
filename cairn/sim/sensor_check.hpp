#pragma once

#include "cairn/sim/world_options.hpp"

namespace cairn {

/// Checks of the sensors that their options' ranges cannot make.
/// @throws ConfigurationError whose where() is the dotted key: no sensor at all, more than nine lasers, more
///   than 255 sensors, a name that two of them share, a mount that is no pose or sticks out of the robot,
///   limits that enclose nothing, measurements that would not fit into memory or onto a disk, a camera above
///   the ceiling, a transmitter or a landmark that is nowhere, a radio or a detector without anything to find
void check_sensors(const WorldOptions& options);

}  // namespace cairn
