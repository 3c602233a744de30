#pragma once

#include "cairn/core/time.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <variant>
#include <vector>

namespace cairn {

/// Pinhole camera without distortion, in pixels. Pixel centres have whole coordinates.
struct PinholeIntrinsics {
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;  ///< column of the optical axis
  double cy_px = 0.0;  ///< row of the optical axis
  friend bool operator==(const PinholeIntrinsics&, const PinholeIntrinsics&) = default;
};

/// One picture of a depth camera: for each pixel the distance along the optical axis (not along the ray).
///
/// The sensor's frame has x along the horizontal part of the optical axis, y to the left, and lies in the
/// plane that the robot drives on; StreamInfo::T_base_sensor is its pose. The camera stands `mount_height_m`
/// above that plane and looks down by `mount_pitch_rad`. For a level camera, pixel (column, row) of depth z
/// is the point x = z, y = -z (column - cx) / fx, height = mount_height_m - z (row - cy) / fy.
///
/// Pixels are stored row by row from the top left: as whole millimetres (0: no reading), or as metres in
/// single precision (NaN, infinite, or not positive: no reading), as the ROS encodings 16UC1 and 32FC1 do.
struct DepthImage {
  using Millimetres = std::vector<std::uint16_t>;
  using Metres = std::vector<float>;

  Time stamp;
  int width = 0;
  int height = 0;
  PinholeIntrinsics intrinsics;
  double mount_height_m = 0.0;
  double mount_pitch_rad = 0.0;  ///< positive: looks down
  double range_min_m = 0.0;      ///< depths that the camera can tell
  double range_max_m = 0.0;
  std::variant<Millimetres, Metres> depths;  ///< width * height

  std::size_t pixels() const {
    return std::visit([](const auto& values) { return values.size(); }, depths);
  }
  /// NaN where there is no reading.
  double depth_m(int column, int row) const {
    const std::size_t i =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
    const auto* millimetres = std::get_if<Millimetres>(&depths);
    const double depth =
        millimetres != nullptr ? 1e-3 * (*millimetres)[i] : double{std::get<Metres>(depths)[i]};
    return depth > 0.0 && std::isfinite(depth) ? depth : std::numeric_limits<double>::quiet_NaN();
  }
};

}  // namespace cairn
