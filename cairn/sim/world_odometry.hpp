#pragma once

#include "cairn/sensing/odometry.hpp"
#include "cairn/sim/mission.hpp"

#include <cstdint>
#include <vector>

namespace cairn {

/// What the wheels tell of the true drive, at every pose of it (50 Hz): systematic errors of wheel radius and
/// base drawn once (Borenstein & Feng 1996), white noise that grows with the way, slips that hide a share of
/// the wheels' motion from the ground, bumps and a kidnapping that the wheels do not see, the wrong sign. The
/// first pose is the origin.
std::vector<Odometry> simulate_world_odometry(const RobotDrive& drive, const WorldOdometryOptions& options,
                                              std::uint64_t seed);

}  // namespace cairn
