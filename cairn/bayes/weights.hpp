#pragma once

#include <span>
#include <vector>

namespace cairn {

/// Turns log-weights of any offset into normalised ones, as normalize_log_weights, and writes the weights
/// themselves: what everything after a correction works with, for one exponential per particle.
/// @returns the effective sample size (sum w)^2 / sum w^2 (Liu 1996): 1..N
double normalize_weights(std::span<double> log_weights, std::vector<double>& weights);

}  // namespace cairn
