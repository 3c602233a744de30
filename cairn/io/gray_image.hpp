#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <string>
#include <vector>

namespace cairn {

/// Picture of 8-bit grey values, rows from the top, 0 = black, 255 = white.
struct GrayImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> gray;
  std::vector<std::uint8_t> opacity;  ///< 255 = opaque; empty if the whole picture is

  std::size_t size() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  friend bool operator==(const GrayImage&, const GrayImage&) = default;
};

/// Most pixels of a picture, and most cells of a map.
inline constexpr std::size_t kMaxCells = std::size_t{1} << 31;

/// The rest of a stream.
std::string read_rest(std::istream& input);

/// Reads PNG or PGM, told by content.
/// @throws InputError for anything else, and as read_png and read_pgm
GrayImage read_image(std::istream& input, const std::string& name);

/// True if these first bytes of a file are those of a picture (PNG, Netpbm, JPEG, BMP, TIFF, GIF).
bool looks_like_image(const std::string& first_bytes);

}  // namespace cairn
