#pragma once

#include "cairn/core/trajectory.hpp"
#include "cairn/localization/estimate.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cairn::app {

/// The figures of two runs over the same events, side by side, and how far they are apart.
/// @param reference  adds the errors of both against it
std::string what_if_table(const std::vector<Estimate>& recorded, const std::vector<Estimate>& what_if,
                          const std::optional<Trajectory>& reference);

/// Poses of the estimates, sorted by stamp.
Trajectory trajectory_of(const std::vector<Estimate>& estimates);

}  // namespace cairn::app
