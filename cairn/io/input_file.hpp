#pragma once

#include <cstddef>
#include <filesystem>
#include <istream>
#include <memory>

namespace cairn {

/// Most that a file may hold, unpacked: 4 GiB.
inline constexpr std::size_t kMaxInputBytes = std::size_t{4} << 30;

/// Opens a file for reading, unpacking gzip, bzip2 and Zstandard on the way (told by content, not by name).
/// The stream holds the whole unpacked content, at most `max_bytes`.
/// @throws InputError if it does not exist, is a directory, may not be read, is empty, does not unpack, or
///   unpacks to more than the limit. A packed file cut short or with garbage is an error that names the byte
///   offset.
std::unique_ptr<std::istream> open_input(const std::filesystem::path& path,
                                         std::size_t max_bytes = kMaxInputBytes);

}  // namespace cairn
