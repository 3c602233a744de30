#pragma once

#include "cairn/io/gray_image.hpp"

#include <ostream>
#include <string>

namespace cairn {

/// PGM picture (Netpbm), plain (P2) or raw (P5), with `#` comments and a maximum value of 1..65535, which
/// becomes 255.
/// @throws InputError naming the byte for a malformed header, sizes that the file does not hold or that
///   exceed kMaxCells, a pixel above the maximum, and anything but white space after the last pixel
GrayImage read_pgm(const std::string& bytes, const std::string& name);

/// Writes a raw PGM (P5, maximum 255). Opacity has no place in it and is left out.
void write_pgm(std::ostream& output, const GrayImage& image);

}  // namespace cairn
