#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace cairn {

enum class UnpackState {
  kComplete,
  kCutShort,  ///< the packed bytes end early; what came out so far is good
  kCorrupt    ///< damaged, or unpacks to more than `limit`; what came out is not to be trusted
};

struct Unpacked {
  std::string bytes;
  UnpackState state = UnpackState::kCorrupt;
};

/// Unpack one bzip2 stream, one LZ4 frame or one Zstandard frame held in memory. The result grows with what
/// really comes out and never beyond `limit` bytes, whatever the packed data announce. Nothing throws but
/// std::bad_alloc.
Unpacked unpack_bz2(std::string_view packed, std::size_t limit);
Unpacked unpack_lz4_frame(std::string_view packed, std::size_t limit);
Unpacked unpack_zstd_frame(std::string_view packed, std::size_t limit);

/// Pack into one frame, with the speed that a running robot can afford.
std::string pack_lz4_frame(std::string_view bytes);
std::string pack_zstd_frame(std::string_view bytes);
/// The same, faster and with a look-back of 4 MiB for long repetitions: a picture that comes twice costs
/// once.
std::string pack_zstd_pictures(std::string_view bytes);

}  // namespace cairn
