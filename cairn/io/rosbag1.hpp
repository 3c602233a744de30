#pragma once

#include "cairn/io/log.hpp"

#include <istream>
#include <string>
#include <string_view>

namespace cairn {

/// True if a file that begins with `head` (13 bytes are enough) is a ROS 1 bag, of whatever version.
bool is_rosbag1(std::string_view head);

/// Reads a ROS 1 bag of format 2.0 (chunks plain, bz2 or lz4) without ROS. See ros1::Ros1Log for which
/// messages become which streams, for mounts and for lasers mounted upside down.
///
/// The records are read one after the other, so that a bag without index, or with a bad one, is read as far
/// as it goes. If the stream can seek and the bag has an index, its connection records are looked at first
/// (so that messages survive the loss of the chunk that introduced their topic), and it tells where to go on
/// after damage. What was lost stands in Log::diagnostics:
///
/// | kind | meaning |
/// |---|---|
/// | unindexed | the recording was not closed; all that is there was read |
/// | truncated | the file ends before the bag does; the text says how much is missing |
/// | corrupt chunk | does not unpack, or not to what it announced: left out whole |
/// | damaged record | lengths or fields that cannot be; reading went on with the next chunk known |
/// | message of an unknown connection | its connection record was lost |
/// | lost bytes | in the file's (packed) bytes: skipped, or known to be missing |
/// | lost messages | of any type, where index records tell how many a chunk held |
///
/// Numbers that cannot be metres are counted, too (plausible_units.hpp). A chunk may unpack to at most 256
/// MiB.
///
/// @param name  of the file, for messages to the user
/// @throws InputError if it is no ROS 1 bag of format 2.0, is encrypted, or ends within the bag's header.
Log read_rosbag1(std::istream& input, const std::string& name);

}  // namespace cairn
