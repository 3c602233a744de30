#pragma once

#include "apps/cairn/commands.hpp"

namespace cairn::app {

/// `cairn log noise`: how the sensors of a recording err.
void add_log_noise(CLI::App& log, Runner& run);

/// The file that it leaves in its --out folder: an object of "metrics" (by name) and "distributions" (by
/// name, each kNoiseQuantiles evenly spread quantiles).
inline constexpr const char* kNoiseFile = "noise.json";
inline constexpr std::size_t kNoiseQuantiles = 201;

}  // namespace cairn::app
