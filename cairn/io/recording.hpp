#pragma once

#include "cairn/io/log.hpp"
#include "cairn/io/recorder.hpp"
#include "cairn/localization/estimate.hpp"

#include <filesystem>
#include <istream>
#include <string>
#include <vector>

namespace cairn {

/// A recorded run, read back.
struct Recording {
  RunHeader header;
  Log log;  ///< the events exactly as they were taken, in that order; diagnostics of the file
  std::vector<Estimate> estimates;
  bool finished = false;  ///< the run came to its end; else it was killed, and later estimates may be missing
};

/// Reads what a Recorder wrote, also where it was killed.
/// @throws InputError if it is no MCAP file, or no recorded run (its first records are lost)
Recording read_recording(std::istream& input, const std::string& name);
Recording read_recording(const std::filesystem::path& path);

}  // namespace cairn
