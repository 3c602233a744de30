#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/sim/floor_plan.hpp"

#include <optional>

namespace cairn {

/// Distance (m) from the ray's origin, along its heading, to the first wall or cylinder of the plan; nullopt
/// if it meets none. Exact geometry, every wall is tried: the oracle rather than the fast way. A ray that
/// starts inside a cylinder ends at once (0).
std::optional<double> cast_ray(const FloorPlan& plan, const Pose2& ray);

}  // namespace cairn
