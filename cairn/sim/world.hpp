#pragma once

#include "cairn/core/trajectory.hpp"
#include "cairn/maps/occupancy_grid.hpp"
#include "cairn/maps/vector_map.hpp"
#include "cairn/sim/route_planner.hpp"
#include "cairn/sim/world_options.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace cairn {

/// A door leaf that is there while the door is closed.
struct WorldDoor {
  Wall leaf;
  double open_s = 0.0;
  double closed_s = 0.0;
  double phase_s = 0.0;

  bool is_closed(double time_s) const;
};

/// From where to where something stands, metres above the floor.
struct HeightSpan {
  static constexpr std::int32_t kNoBox = -1;

  double bottom_m = 0.0;
  double top_m = 0.0;
  std::int32_t box = kNoBox;  ///< index of the furniture that the wall is a side of

  bool contains(double height_m) const { return height_m >= bottom_m && height_m <= top_m; }
};

/// A world that can be driven through: checked, and with everything that the simulation of robot and sensors
/// needs.
struct World {
  WorldOptions options;
  std::shared_ptr<const VectorMap> solid;  ///< all that stands, but doors and people
  std::vector<HeightSpan> spans;           ///< of each wall of `solid`
  OccupancyGrid map;     ///< what the localizer is given: without people and what is not on_map
  RoutePlanner planner;  ///< for the robot, doors open
  std::vector<WorldDoor> doors;
  Pose2 start;
  Trajectory path;  ///< of a recorded mission, 50 Hz from time zero; empty for all others
};

/// Builds the world and checks it.
/// @param floor  walls from the file that the options name, else none
/// @param recorded  poses of a real robot that a recorded mission repeats (T_map_base); then robot.start is
/// the
///   first of them, and no wall may be crossed, but walls may come nearer than robot.radius_m
/// @throws ConfigurationError whose where() is the dotted key of what does not fit: a wall of fewer than two
/// points, a
///   closed one of fewer than three, floors that do not enclose the start, a start in a wall, a sensor that
///   sticks out of the robot, no sensor, limits that enclose nothing, more messages than fit into memory, a
///   radio or a detector without anything to find, a name that two sensors share
World make_world(const WorldOptions& options, std::span<const Wall> floor = {},
                 const Trajectory& recorded = {});

/// The options of a built-in world: "office" (another one for every seed), "cross" (15 m, fully symmetric),
/// "hall" (60 x 60 m, ringed by offices), "corridor" (100 m, the same every 5 m), "warehouse". Empty for an
/// empty name.
WorldOptions built_in_world(const std::string& name, std::uint64_t seed);

}  // namespace cairn
