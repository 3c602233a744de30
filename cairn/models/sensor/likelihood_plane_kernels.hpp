#pragma once

#include "cairn/core/pose2.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace cairn {

// The inner loop of LikelihoodPlane::sum_codes, for the best instructions of the machine (see simd.hpp).

/// Codes row by row; one of the two is there. Neither side is longer than 2^20 cells.
struct LikelihoodPlaneView {
  const std::uint8_t* narrow;
  const std::uint16_t* wide;
  std::uint32_t columns;
  std::uint32_t rows;
};

/// End points in cells; kBeamPadding more of them may be read.
struct BeamsView {
  const float* x;
  const float* y;
  std::size_t count;
};
inline constexpr std::size_t kBeamPadding = 16;

/// Robot poses in cells of the plane, headings in [-pi, pi]; all finite and at most 2^23 cells away. The
/// arrays hold something finite in the places behind the last pose.
struct PoseBlock {
  static constexpr std::size_t kCapacity = 128;
  alignas(64) std::array<float, kCapacity> x;
  alignas(64) std::array<float, kCapacity> y;
  alignas(64) std::array<float, kCapacity> heading;
  std::size_t count = 0;
  alignas(64) std::array<float, kCapacity> sine;
  alignas(64) std::array<float, kCapacity> cosine;
  std::array<std::uint32_t, kCapacity> sums;  ///< the result
};

/// Where a plane's cells lie: T_grid_map in cells of the plane.
struct PlaneFrame {
  double cosine, sine;  ///< times cells per metre
  double x, y;          ///< of the map's origin, border included
  double theta;         ///< of the map's x-axis, rad
};

/// Positions and end points beyond are as good as anywhere off the map: no grid is larger. Those that are not
/// near are put at 4 times as much along both axes: no turn and no beam brings them back onto the map.
inline constexpr double kFarAway_cells = 1 << 20;

/// Puts poses (T_map_base), at most kCapacity, into the block.
void put_in_cells(const PlaneFrame& frame, std::span<const Pose2> states, PoseBlock& block);

/// Sets sums[i] to the codes of all beams seen from pose i, added up.
void sum_codes(const LikelihoodPlaneView& plane, const BeamsView& beams, PoseBlock& poses);

}  // namespace cairn
