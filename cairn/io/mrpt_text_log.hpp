#pragma once

#include "cairn/io/log.hpp"

#include <istream>
#include <string>

namespace cairn {

/// Reads the text form of an MRPT rawlog with wheel odometry, one planar laser and radio beacons: metres,
/// radians, seconds since 1970.
///
/// - `FRAME k`: the lines that follow belong to frame k.
/// - `ODO dx dy dtheta`: motion from frame k to frame k+1, in the robot's frame at k.
/// - `LASER t n range_max aperture x y z r1..rn`: scan "laser", beams from the right to the left, mounted at
///   (x, y, 0); just before it, with the same stamp, the pose of frame k as odometry "odom", from (0, 0, 0)
///   on.
/// - `BEACON id range`: one of the readings of "uwb", stamped as the scan of its frame (without one: counted
///   as "beacon without stamp"); a range of 0 is none, a second one of the same beacon is counted as "beacon
///   told twice". Where the antenna is the log does not tell.
///
/// A range of `range_max` or more is no return.
/// Beams stand aperture/(n-1) apart, starting at -aperture/2. What is done about malformed lines: see
/// read_text_log in text_log.hpp. A malformed ODO line loses its motion.
/// @param name  of the file, for messages
/// @throws InputError see read_text_log
Log read_mrpt_text_log(std::istream& input, const std::string& name);

}  // namespace cairn
