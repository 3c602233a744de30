#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace cairn {

/// Cumulative sums of exp(log_weights), the last one exactly 1. @pre not empty, log-weights normalised
std::vector<double> cumulative_weights(std::span<const double> normalized_log_weights);

/// Systematic resampling (Kitagawa 1996; Thrun et al., Probabilistic Robotics, table 4.4): appends to
/// `ancestors` the indices under a comb of `count` equally spaced teeth whose first lies at `offset` (0..1)
/// of the spacing. Each index is drawn within 1 of count * w_i times. O(N + count).
void draw_systematic(std::span<const double> cumulative, std::size_t count, double offset,
                     std::vector<std::uint32_t>& ancestors);

}  // namespace cairn
