#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace cairn {

// The inner loop of RayMarcher::cast, for the best instructions of the machine (see simd.hpp).

/// How far a ray may go on from anywhere in a cell, in quarters of a cell plus one; 0 in cells that end it
/// and in the border around the grid. No step leads over the border. Three bytes more than there are cells
/// may be read.
struct StepPlaneView {
  const std::uint8_t* steps;
  std::uint32_t columns;  ///< with the border
  std::uint32_t rows;
  float beyond;     ///< every step goes on by this much, in cells, so that rounding keeps no ray in its cell
  float max_range;  ///< in cells: where every ray ends
  float metres;     ///< per cell
  float max_range_m;
};
inline constexpr float kCellsPerStep = 0.25f;

/// Poses in cells of the plane, within the grid.
struct RayOrigins {
  static constexpr std::size_t kCapacity = 64;
  alignas(64) std::array<float, kCapacity> x;
  alignas(64) std::array<float, kCapacity> y;
  alignas(64) std::array<float, kCapacity> cosine;
  alignas(64) std::array<float, kCapacity> sine;
  alignas(64) std::array<float, kCapacity> free;  ///< how far every ray may go at once, in cells
};

/// Casts one bearing from all origins. ranges_m[i]: where the ray enters the cell that ends it, and
/// `max_range_m` if it leaves the grid or gets so far.
void march(const StepPlaneView& plane, const RayOrigins& origins, float bearing_cosine, float bearing_sine,
           std::array<float, RayOrigins::kCapacity>& ranges_m);

}  // namespace cairn
