#pragma once

#include "cairn/core/time.hpp"

#include <cstdint>
#include <vector>

namespace cairn {

/// A small grey picture of the ceiling from a camera that looks straight up, drawn as a map is: seen from
/// above, x of the sensor's frame up, y to the left.
///
/// Pixels are stored row by row from the top left. Pixel (column, row) shows the point
/// x = metres_per_pixel ((height - 1) / 2 - row), y = metres_per_pixel ((width - 1) / 2 - column) of the
/// ceiling.
struct CeilingPatch {
  Time stamp;
  int width = 0;
  int height = 0;
  double metres_per_pixel = 0.0;   ///< on the ceiling
  std::vector<std::uint8_t> gray;  ///< width * height; 0 black, 255 white
};

}  // namespace cairn
