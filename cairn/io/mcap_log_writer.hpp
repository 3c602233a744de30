#pragma once

#include "cairn/io/event_writer.hpp"
#include "cairn/io/log.hpp"
#include "cairn/io/mcap_writer.hpp"

#include <filesystem>
#include <ostream>
#include <vector>

namespace cairn {

/// Writes a log as MCAP, one event after the other: read_log gives back the same streams and events to the
/// last bit, and tools for ROS 2 open it as it is (event_writer.hpp says what they see).
class McapLogWriter {
 public:
  /// @param output  must outlive the writer
  McapLogWriter(std::ostream& output, const std::vector<StreamInfo>& streams,
                mcap::Compression compression = mcap::Compression::kLz4);

  /// @throws InputError for an event that does not fit its stream
  void add(const Event& event);
  /// Writes what is left. A log that is not finished can be read as far as it goes.
  void finish();

 private:
  void store();

  std::ostream& output_;
  mcap::Writer writer_;
  EventWriter events_;
};

/// Writes the whole log. Diagnostics are not written.
/// @throws InputError for an event that does not fit its stream
void write_mcap_log(std::ostream& output, const Log& log,
                    mcap::Compression compression = mcap::Compression::kLz4);

/// @throws InputError also if the file cannot be written
void write_mcap_log(const std::filesystem::path& path, const Log& log,
                    mcap::Compression compression = mcap::Compression::kLz4);

}  // namespace cairn
