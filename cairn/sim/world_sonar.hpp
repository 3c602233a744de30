#pragma once

#include "cairn/sensing/sonar_scan.hpp"
#include "cairn/sim/sensor_view.hpp"

#include <optional>

namespace cairn {

/// Where sound that leaves along a ray comes back from: the length of the way to the first surface that it
/// meets within `critical_rad` of the surface's normal, or to a person. Steeper surfaces turn it aside, as
/// mirrors do light; after two of them it is lost.
std::optional<double> sonar_echo(const WorldScene& scene, const WorldSonarOptions& options,
                                 const Point2& origin, double angle_rad);

/// One round of the ring. Each transducer tells the shortest echo within its cone, with noise; `range_max_m`
/// for none.
SonarScan simulate_sonar(const SensorView& view, const WorldSonarOptions& options);

}  // namespace cairn
