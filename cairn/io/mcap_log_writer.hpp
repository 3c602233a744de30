#pragma once

#include "cairn/io/log.hpp"
#include "cairn/io/mcap_writer.hpp"

#include <filesystem>
#include <ostream>

namespace cairn {

/// Writes a log as MCAP: read_log gives back the same streams and events to the last bit, and tools for ROS 2
/// open it as it is (event_writer.hpp says what they see). Diagnostics are not written.
/// @throws InputError for an event that does not fit its stream
void write_mcap_log(std::ostream& output, const Log& log,
                    mcap::Compression compression = mcap::Compression::kLz4);

/// @throws InputError also if the file cannot be written
void write_mcap_log(const std::filesystem::path& path, const Log& log,
                    mcap::Compression compression = mcap::Compression::kLz4);

}  // namespace cairn
