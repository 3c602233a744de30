#pragma once

#include "cairn/core/trajectory.hpp"
#include "cairn/sim/world.hpp"

#include <cstdint>

namespace cairn {

/// The true drive through a world: T_map_base, 50 poses per second from time zero.
struct RobotDrive {
  Trajectory truth;
  /// Index of the first pose after a kidnapping (the robot did not drive there); 0 for none.
  std::size_t kidnapped_to = 0;
};

/// Plans the mission and drives it. Waypoints are reached on the shortest ways around walls; a polyline is
/// driven straight; a random mission goes to random free places; a coverage drive goes over all free space in
/// lanes. The way begins again at its first point if the duration is longer.
/// A recorded mission is World::path.
/// @throws ConfigurationError with where() = the key for points in walls, ways through walls, points that
/// cannot be
///   reached, and a kidnapping to a place that is not free
RobotDrive drive_mission(const World& world, std::uint64_t seed);

}  // namespace cairn
