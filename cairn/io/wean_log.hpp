#pragma once

#include "cairn/core/trajectory.hpp"
#include "cairn/io/log.hpp"

#include <istream>
#include <string>

namespace cairn {

/// Reads a log of the Wean Hall data set: one message a line, centimetres, radians, seconds since the start.
///
/// - `O x y theta t`: odometry stream "odom".
/// - `L x y theta xl yl thetal r1..r180 t` (pose of the robot, pose of the laser, ranges): scans "laser", and
///   just before each scan the robot's pose, with the same stamp, as odometry "laser_odom".
///
/// The log tells no angles but "180 readings over 180 degrees from the right to the left". They are read as 1
/// degree apart, from -90 to +89 degrees: the SICK LMS measures at whole degrees and gives 181 beams, of
/// which this log (like CARMEN) keeps 180; 180/179 degrees cannot come from it. The laser's mounting pose is
/// that of its pose in the robot's frame, if all L lines agree (0.25 m ahead). What is done about malformed
/// lines and the missing maximum range: see read_text_log in text_log.hpp.
/// @param name  of the file, for messages
/// @throws InputError see read_text_log
Log read_wean_log(std::istream& input, const std::string& name);

/// Reads a file of the same format as the reference of a run: the robot's poses of its O and L lines, in the
/// order of their stamps. (robotdata101.log holds poses in the frame of the map.)
/// @throws InputError also if one line is malformed: a reference must be whole
Trajectory read_wean_trajectory(std::istream& input, const std::string& name);

}  // namespace cairn
