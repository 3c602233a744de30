#pragma once

#include <cstddef>
#include <cstdint>

namespace cairn {

// The loops of truncated_squared_distances, for the best instructions of the machine (see simd.hpp).

/// Consecutive whole rows: `cells` are the grid's percentages, `out` the distances in cells.
struct RowBand {
  const std::int8_t* cells;
  std::uint8_t* out;
  std::size_t columns;
  std::size_t rows;
};

/// Distance in cells to the next occupied cell (of at least `occupied_from` percent) above or below, at most
/// `cap`.
void distances_in_columns(const RowBand& band, std::int8_t occupied_from, std::uint8_t cap);

/// squares[x] = distances[x]^2, and `far` where the distance is `cap`. Reads and writes up to 64 bytes more.
void square_row(const std::uint8_t* distances, std::uint8_t cap, std::uint16_t far, std::uint16_t* squares,
                std::size_t columns);

/// out[x] = min(far, min over |k| <= radius of squares[x + k] + k^2). `squares` is read `radius` + 32 cells
/// beyond both ends, `out` is written up to 32 cells beyond.
void least_in_windows(const std::uint16_t* squares, std::uint16_t far, int radius, std::uint16_t* out,
                      std::size_t columns);

}  // namespace cairn
