#pragma once

#include "cairn/core/pose2.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

namespace cairn {

/// A small block of cells in (x, y, heading), numbered heading by heading, then along x, then along y.
struct PoseCells {
  double cells_per_m = 1.0;
  double first_x = 0.0;  ///< of the block, in cells: whole numbers
  double first_y = 0.0;
  std::int32_t side = 1;      ///< cells along x, and along y: a power of two
  std::int32_t headings = 1;  ///< that fill the circle, from 0 on; numbers stay below 2^31

  static constexpr std::int32_t kNone = -1;

  static constexpr double kLargestHeading = 6.28;  ///< rad, less than a full turn

  /// The cell of a pose, in plain words; kNone outside the block and for headings beyond kLargestHeading.
  /// Headings that differ by a full turn share a cell.
  std::int32_t cell_of(const Pose2& pose) const;
};

/// What mark_cells did.
struct CellsMarked {
  std::size_t fresh = 0;      ///< cells that had another mark before
  std::size_t elsewhere = 0;  ///< poses whose cell is kNone
};

/// Marks the cells of all poses, on all lanes of the processor (see simd.hpp): those of PoseCells::cell_of,
/// exactly. The indices of the poses without a cell are written to the front of `elsewhere`, in their order.
/// @param marks one per cell
/// @pre `elsewhere` is as large as `poses`
CellsMarked mark_cells(const PoseCells& cells, std::span<const Pose2> poses, std::uint8_t mark,
                       std::span<std::uint8_t> marks, std::span<std::uint32_t> elsewhere);

}  // namespace cairn
