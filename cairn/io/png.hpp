#pragma once

#include "cairn/io/gray_image.hpp"

#include <ostream>
#include <string>

namespace cairn {

/// PNG picture of any kind as 8-bit grey: colours become the mean of red, green and blue, palettes are looked
/// up, 16 bits are scaled to 8. No gamma or colour profile is applied: in a map the stored numbers count.
/// @throws InputError for what libpng refuses, sizes above kMaxCells or larger than the packed data can hold
GrayImage read_png(const std::string& bytes, const std::string& name);

/// Writes an 8-bit grey PNG. Opacity is left out.
/// @throws InputError if libpng cannot (a picture without pixels)
void write_png(std::ostream& output, const GrayImage& image);

}  // namespace cairn
