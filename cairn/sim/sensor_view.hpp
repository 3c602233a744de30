#pragma once

#include "cairn/core/trajectory.hpp"
#include "cairn/maps/wall_grid.hpp"
#include "cairn/sim/people.hpp"
#include "cairn/sim/simulation_random.hpp"
#include "cairn/sim/world_scene.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace cairn {

/// All that simulated sensors can look at.
struct SimulatedDrive {
  const World& world;
  const WallGrid& walls;  ///< of world.solid, for all materials
  const People& people;
  const Trajectory& truth;
  std::uint64_t seed = 0;
  std::size_t kidnapped_to = 0;  ///< as in RobotDrive
};

/// One measurement of one sensor: measurements of different sensors or index have independent noise.
struct SensorView {
  const SimulatedDrive& drive;
  std::size_t sensor = 0;   ///< its place among all sensors of the world
  std::uint64_t index = 0;  ///< of the measurement
  Time measured;            ///< when, in truth
  Time stamp;               ///< when, as the sensor says

  WorldScene scene() const { return {drive.world, drive.walls, drive.people, to_seconds(measured)}; }

  /// T_map_base when it was measured.
  Pose2 base_in_map() const {
    const Time t = std::clamp(measured, drive.truth.front().stamp, drive.truth.back().stamp);
    return *pose_at(drive.truth, t);
  }

  RandomStream random(SimulationUse use) const {
    return simulation_random(drive.seed, use, step_of_stream(sensor, index));
  }
};

}  // namespace cairn
