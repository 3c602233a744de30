#pragma once

#include "cairn/core/diagnostics.hpp"
#include "cairn/core/trajectory.hpp"

#include <filesystem>
#include <istream>
#include <ostream>
#include <string>

namespace cairn {

/// TUM RGB-D text: `t x y z qx qy qz qw` per line (s, m, unit quaternion), blanks between, `#` comments.
/// The planar part is taken: x, y, and the yaw of the quaternion; z is read and dropped.
/// @param name  of the stream, for messages
/// @param diagnostics  what was repaired, see PoseCollector
/// @throws InputError file:line:column for a malformed line or a quaternion whose length is not 1 (+-1 %)
Trajectory read_tum(std::istream& input, const std::string& name, Diagnostics& diagnostics);

/// Writes the same format: stamps to the nanosecond, positions to 1e-9 m. The bytes depend on nothing else
/// (no locale).
void write_tum(std::ostream& output, const Trajectory& trajectory);

/// @throws InputError if the file cannot be written
void write_tum(const std::filesystem::path& path, const Trajectory& trajectory);

}  // namespace cairn
