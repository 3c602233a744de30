#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/maps/distance_field.hpp"

#include <span>

namespace cairn {

/// Share of the points (in the robot's base frame) that lie within `within_m` of an occupied cell, seen from
/// `T_map_base`: 0..1; points off the map count as far; 0 without points.
double share_near_walls(const DistanceField& field, std::span<const Point2> points, const Pose2& T_map_base,
                        double within_m);

}  // namespace cairn
