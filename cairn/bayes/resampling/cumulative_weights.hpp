#pragma once

#include <span>
#include <vector>

namespace cairn {

/// Cumulative sums of exp(log_weights), the last one exactly 1. @pre not empty, log-weights normalised
std::vector<double> cumulative_weights(std::span<const double> normalized_log_weights);

/// The same into a vector that is used again and again, so that it allocates only when it grows.
void cumulative_weights(std::span<const double> normalized_log_weights, std::vector<double>& cumulative);

/// Cumulative sums of weights, divided by the last one: that is exactly 1, and none falls below the one
/// before. The order of the additions is fixed. @pre not empty, no weight negative, not all 0; `cumulative`
/// is not `weights`
void cumulative_sums(std::span<const double> weights, std::vector<double>& cumulative);

}  // namespace cairn
