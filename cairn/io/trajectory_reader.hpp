#pragma once

#include "cairn/core/diagnostics.hpp"
#include "cairn/core/trajectory.hpp"
#include "cairn/io/carmen_trajectory.hpp"

#include <filesystem>
#include <vector>

namespace cairn {

struct TrajectoryOptions {
  CarmenPose carmen_pose = CarmenPose::kLaser;  ///< which pose of a CARMEN log
  /// Stamps of the log's frames, for a path that numbers its poses (read_indexed_trajectory); else not used.
  std::vector<Time> frame_stamps = {};
  int frame_offset = 1;  ///< row k belongs to frame k + this (MRPT)
};

/// Reads a trajectory file (plain, gzip or bzip2), whose format is told by its first line of data: CARMEN,
/// TUM (8 fields), plain `t x y theta` (4 fields), Rawseeds CSV (commas), or numbered poses (0, 1, 2, ... x y
/// theta).
/// @param diagnostics  what was repaired: stamps sorted, duplicates dropped; see PoseCollector
/// @throws InputError file:line:column for a malformed line (a reference with holes would lie), for a
///   format that is none of these, for numbered poses without `frame_stamps`; as open_input for a file that
///   cannot be read
Trajectory read_trajectory(const std::filesystem::path& path, const TrajectoryOptions& options,
                           Diagnostics& diagnostics);
Trajectory read_trajectory(const std::filesystem::path& path);

/// The same from a stream that can be rewound.
Trajectory read_trajectory(std::istream& input, const std::string& name, const TrajectoryOptions& options,
                           Diagnostics& diagnostics);

}  // namespace cairn
