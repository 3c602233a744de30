#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace cairn {

/// Indices, increasing, of at most `max_points` (>= 4) of `values` that draw the same curve: the first, the
/// last, and of each of equally long stretches between them the smallest and the largest, so that no peak is
/// lost. All indices where there are no more than `max_points`.
std::vector<std::size_t> select_extremes(std::span<const double> values, std::size_t max_points);

/// Indices, increasing, of at most `max_points` (>= 2) of `count` elements, evenly spread, with the first and
/// the last.
std::vector<std::size_t> select_evenly(std::size_t count, std::size_t max_points);

}  // namespace cairn
