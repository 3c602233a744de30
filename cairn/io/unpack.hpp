#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace cairn {

enum class Packing { kNone, kGzip, kBzip2, kZstd };

/// Told by the first bytes: 1f 8b is gzip, "BZh1".."BZh9" is bzip2, 28 b5 2f fd is Zstandard.
Packing packing_of(std::string_view bytes);

/// Unpacks a gzip file held in memory: one member or several, one after the other (RFC 1952).
/// @param name       of the file, for messages
/// @param max_bytes  most that it may unpack to; memory stays below about twice that
/// @throws InputError "name (byte N): ..." where N is an offset in the packed bytes, if the data is cut
///   short or damaged, is followed by something else, or unpacks to more than `max_bytes`.
std::string unpack_gzip(std::string_view packed, const std::string& name, std::size_t max_bytes);

/// The same for bzip2: one stream or several, one after the other.
std::string unpack_bzip2(std::string_view packed, const std::string& name, std::size_t max_bytes);

/// The same for Zstandard: one frame or several, one after the other.
std::string unpack_zstd(std::string_view packed, const std::string& name, std::size_t max_bytes);

}  // namespace cairn
