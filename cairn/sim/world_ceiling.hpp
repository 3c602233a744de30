#pragma once

#include "cairn/sensing/ceiling_patch.hpp"
#include "cairn/sim/sensor_view.hpp"

namespace cairn {

/// Brightness of the ceiling above a point of the map, 0..255: tiles of slightly different grey with dark
/// joints, some of them lamps, and stains. A pure function of the point and `ceiling.pattern`, so that the
/// picture that is taken today fits the map that was made yesterday.
double ceiling_gray(const WorldCeilingOptions& options, const Point2& point);

/// What a camera that looks straight up sees, with noise, in the brightness of its exposure.
CeilingPatch simulate_ceiling(const SensorView& view, const WorldCeilingCameraOptions& options);

}  // namespace cairn
