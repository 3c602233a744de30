#pragma once

#include "cairn/io/log.hpp"

#include <filesystem>
#include <ostream>

namespace cairn {

/// Writes a log as CARMEN text, the format that read_carmen_log reads and most tools for planar lasers know.
///
/// | in the log | becomes |
/// |---|---|
/// | the odometry stream | `ODOM`, speeds written as 0 |
/// | laser stream i (1 to 9) whose mount is known | `ROBOTLASERi`, with the odometry at the scan's stamp as
/// robot pose | | laser stream i without a mount | `RAWLASERi` | | mount (x, 0, 0) of the first laser |
/// `PARAM robot_frontlaser_offset x` as well |
///
/// Events keep their order; stamps keep their nanoseconds, arrival is the logger's timestamp. Poses are
/// printed to 1e-6 m and rad, ranges to 1 mm, beam angles to 1e-9 rad; a range that is not finite is written
/// as the maximum range (no return). The smallest range and the names of streams and frames are lost.
/// @throws InputError if the log has not one odometry stream, more than nine lasers, or a payload that does
///   not fit its stream's kind
void write_carmen_log(std::ostream& output, const Log& log);

/// @throws InputError also if the file cannot be written
void write_carmen_log(const std::filesystem::path& path, const Log& log);

}  // namespace cairn
