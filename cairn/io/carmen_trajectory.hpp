#pragma once

#include "cairn/core/diagnostics.hpp"
#include "cairn/core/trajectory.hpp"

#include <istream>
#include <string>

namespace cairn {

/// Which of the two poses in a CARMEN laser message.
enum class CarmenPose {
  kLaser,  ///< of the laser: what a corrected log corrects
  kRobot,  ///< of the robot
};

/// The poses in the laser messages (FLASER, ROBOTLASER1) of a CARMEN log, as a trajectory. In a *corrected*
/// log (from a mapping program) that is the path; in a raw log it is odometry. Stamped with the message's
/// first time (the sensor's; the last field is the logger's). Other messages are passed over.
/// @throws InputError file:line:column for a malformed laser message, and if there is none
Trajectory read_carmen_trajectory(std::istream& input, const std::string& name, CarmenPose which,
                                  Diagnostics& diagnostics);

}  // namespace cairn
