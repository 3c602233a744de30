#pragma once

#include "cairn/io/log.hpp"

#include <istream>
#include <string>

namespace cairn {

/// Reads a CARMEN log (*.log, *.clf): one message a line, in metres, radians and seconds:
/// `NAME contents ipc_timestamp ipc_host logger_timestamp`.
///
/// - `ODOM x y theta tv rv accel`: odometry stream "odom".
/// - `FLASER n r1..rn x y theta odom_x odom_y odom_theta`: scans "flaser", and just before each scan the
///   robot's pose (odom_*), with the same stamp, as odometry "flaser_odom". `RLASER` likewise.
/// - `ROBOTLASER1 type start fov resolution max accuracy remission_mode n r1..rn m i1..im laser_x laser_y
///   laser_theta robot_x robot_y robot_theta tv rv forward side turn`: scans "robotlaser1" and odometry
///   "robotlaser1_odom". Any other digit likewise.
/// - `RAWLASER1`: the same up to i1..im: scans "rawlaser1".
/// - `PARAM robot_frontlaser_offset x`: flaser is mounted at (x, 0, 0).
/// - `PARAM robot_rearlaser_offset x`: rlaser is mounted at (x, 0, pi).
/// - `SYNC` is ignored; other messages of CARMEN are counted as "unsupported message", other upper-case names
///   as "unknown message".
///
/// Stamps are the ipc timestamps. They may run backwards, and then be wrong: the odometry of the intel log is
/// continuous in the order of the file, not in that of its stamps (path 508 m against 661 m). The events keep
/// the order of the file. The arrival is the logger's timestamp where that is 0 to 10 s later, else the stamp
/// (most loggers count from their own start).
///
/// The mounting pose of ROBOTLASER streams is the laser's pose in the robot's frame, if all messages agree.
///
/// FLASER and RLASER tell no angles. CARMEN's rule is that n beams look over 180 degrees, starting at -90
/// degrees (right) counter-clockwise, 180/(n-1) degrees apart if n is odd (181, 361) and 180/n if n is even
/// (180, 360: the scanner's last beam was dropped); 401 beams are 0.25 degrees apart, starting at -50
/// degrees. They tell no maximum range either: see read_text_log in text_log.hpp, and there also what is done
/// about malformed lines.
///
/// @param name  of the file, for messages
/// @throws InputError see read_text_log
Log read_carmen_log(std::istream& input, const std::string& name);

/// True if `word`, the first of a line, is a message name that CARMEN's loggers write.
bool is_carmen_message(std::string_view word);

}  // namespace cairn
