#pragma once

#include "cairn/core/diagnostics.hpp"
#include "cairn/io/mcap_records.hpp"

#include <functional>
#include <istream>
#include <string>
#include <string_view>

namespace cairn::mcap {

/// True if a file that begins with `head` (8 bytes are enough) is an MCAP file.
bool is_mcap(std::string_view head);

/// A message as a reader hands it over; the views hold until the function that it is given to returns.
struct MessageView {
  const Schema& schema;  ///< an empty one for a channel without
  const Channel& channel;
  const Message& message;
  std::uint64_t offset;  ///< of its record or chunk in the file, for the user
};

/// What read() calls, in the order of the file. A channel is told once, before its first message.
struct Handlers {
  std::function<void(const Schema&, const Channel&)> on_channel = [](const Schema&, const Channel&) {};
  std::function<void(const MessageView&)> on_message = [](const MessageView&) {};
  std::function<void(const Metadata&)> on_metadata = [](const Metadata&) {};
};

/// Reads an MCAP file (chunks plain, lz4 or zstd), record by record, so that a file without index, or with a
/// bad one, is read as far as it goes. If the file was closed and the stream can seek, its index tells where
/// to go on after damage. What was lost stands in `diagnostics`:
///
/// | kind | meaning |
/// |---|---|
/// | unfinished | the recording was not closed; all that is there was read |
/// | truncated | the file ends within a record; the text says how much is missing |
/// | corrupt chunk | does not unpack, or not to what its checksum says: left out whole |
/// | damaged record | fields that cannot be; reading went on with the next record or chunk known |
/// | message of an unknown channel | its channel record was lost |
/// | lost bytes | in the file: skipped, or known to be missing |
/// | lost messages | where the file's statistics tell how many it held |
///
/// A chunk that the end of the file cuts is unpacked as far as it goes. A chunk may unpack to at most 256
/// MiB.
/// @param name  of the file, for messages to the user
/// @return the file's header
/// @throws InputError if it is no MCAP file of version 0, or ends within its header
Header read(std::istream& input, const std::string& name, const Handlers& handlers, Diagnostics& diagnostics);

}  // namespace cairn::mcap
