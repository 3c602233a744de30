#pragma once

#include "cairn/core/pose2.hpp"

#include <istream>
#include <string>
#include <vector>

namespace cairn {

/// Reads one scan as text: a line per beam with its bearing (rad, counter-clockwise from straight ahead) and
/// its range (m), separated by blanks or a comma; lines that begin with # are skipped. A range that is
/// infinite, NaN or not positive is no return and left out.
/// @return the end points in the sensor's frame
/// @throws InputError with file, line and column for anything else, or if no beam has a return
std::vector<Point2> read_beams(std::istream& input, const std::string& name);

}  // namespace cairn
