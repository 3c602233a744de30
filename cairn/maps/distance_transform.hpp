#pragma once

#include "cairn/core/executor.hpp"
#include "cairn/core/large_vector.hpp"
#include "cairn/maps/occupancy_grid.hpp"

#include <cstdint>
#include <vector>

namespace cairn {

/// Squared Euclidean distance, in cells, from the centre of every cell to the centre of the nearest occupied
/// one; infinite where there is none (Felzenszwalb & Huttenlocher, "Distance Transforms of Sampled
/// Functions", 2012). Plain and exact for grids of any size; the oracle of the fast transform.
std::vector<double> squared_distances(const OccupancyGrid& grid);

/// Radii beyond this do not fit the fast transform.
inline constexpr int kMostTruncationCells = 255;

/// The same as an integer, exact below `far`, and `far` where no occupied cell is nearer than that.
///
/// Two passes: along the columns the distance to the next occupied cell, up to the truncation radius; along
/// the rows the least sum of squares in a window of that radius (Saito & Toriwaki 1994). Both on all lanes of
/// the processor; threads of `executor` change no value.
/// @param far squared cells, 1 to kMostTruncationCells^2
/// @returns `grid.geometry().size()` values, row by row
LargeVector<std::uint16_t> truncated_squared_distances(const OccupancyGrid& grid, std::uint16_t far,
                                                       const Executor& executor);

}  // namespace cairn
