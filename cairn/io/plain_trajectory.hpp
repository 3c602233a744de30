#pragma once

#include "cairn/core/diagnostics.hpp"
#include "cairn/core/trajectory.hpp"

#include <istream>
#include <span>
#include <string>

namespace cairn {

/// `t x y theta` per line (s, m, m, rad), blanks between, `#` comments.
/// @throws InputError file:line:column for a malformed line
Trajectory read_plain_trajectory(std::istream& input, const std::string& name, Diagnostics& diagnostics);

/// Rawseeds CSV: `t, x, y, theta` per line, then nothing or the nine entries of a covariance, which are
/// checked to be numbers and dropped.
/// @throws InputError file:line:column for a malformed line
Trajectory read_rawseeds_trajectory(std::istream& input, const std::string& name, Diagnostics& diagnostics);

/// `k x y theta` per line: a path whose poses are numbered instead of stamped (MRPT ground truth). Row k
/// belongs to frame k + `offset` of a log and takes the stamp of that frame.
/// @param frame_stamps  of the log, in its order
/// @throws InputError file:line:column for a malformed line or a number outside the log
Trajectory read_indexed_trajectory(std::istream& input, const std::string& name,
                                   std::span<const Time> frame_stamps, int offset, Diagnostics& diagnostics);

/// True if every row is numbered 0, 1, 2, ... in whole numbers without a decimal point. Reads the stream to
/// its end.
bool is_indexed_trajectory(std::istream& input);

}  // namespace cairn
