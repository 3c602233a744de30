#pragma once

#include "cairn/core/pose2.hpp"

#include <cstdint>
#include <span>

namespace cairn {

/// A small block of cells in (x, y, heading), numbered heading by heading, then along x, then along y.
struct PoseCells {
  double cells_per_m = 1.0;
  double first_x = 0.0;  ///< of the block, in cells: whole numbers
  double first_y = 0.0;
  std::int32_t side = 0;      ///< cells along x, and along y
  std::int32_t headings = 1;  ///< that fill the circle, from 0 on; numbers stay below 2^31

  static constexpr std::int32_t kNone = -1;

  /// The cell of a pose, in plain words; kNone outside the block and where the heading is not in [-pi, pi).
  std::int32_t cell_of(const Pose2& pose) const;
};

/// The cells of all poses, on all lanes of the processor (see simd.hpp): those of PoseCells::cell_of,
/// exactly.
/// @pre equal sizes
void find_cells(const PoseCells& cells, std::span<const Pose2> poses, std::span<std::int32_t> out);

}  // namespace cairn
