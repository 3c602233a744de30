#pragma once

#include "cairn/io/log.hpp"

#include <istream>
#include <string>

namespace cairn {

/// Reads an MCAP file: a bag of ROS 2 (profile ros2, CDR), or a recording of Cairn. See ros2::Ros2Log for
/// which messages of ROS 2 become which streams, and mcap_reader.hpp for unfinished and damaged files.
///
/// A recording of Cairn (recorder.hpp, write_mcap_log) holds every event exactly: these are taken, with the
/// streams as they were, and `format` is "cairn_mcap" rather than "mcap". What is no event any more (a pose
/// that is not finite, a scan without sense) is left out and counted as "malformed message"; to replay what
/// really came, read it with read_recording.
/// @throws InputError as mcap::read, and for more than 4 GiB of scans
Log read_mcap_log(std::istream& input, const std::string& name);

}  // namespace cairn
