#pragma once

#include "cairn/sim/world.hpp"

namespace cairn::test {

/// A room of 8 x 6 m with one laser, a robot at (1, 1) and a mission to the opposite corner and back.
inline WorldOptions small_world_options() {
  WorldOptions options;
  options.walls.push_back({"outline", "0,0 8,0 8,6 0,6", true, "opaque", true});
  options.robot.start = "1,1,0";
  options.robot.points = "7,5 1,1";
  options.lasers.emplace_back().name = "front";
  options.lasers.back().beams = 91;
  return options;
}

}  // namespace cairn::test
