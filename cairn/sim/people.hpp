#pragma once

#include "cairn/core/trajectory.hpp"
#include "cairn/sim/floor_plan.hpp"
#include "cairn/sim/world.hpp"

#include <cstdint>
#include <vector>

namespace cairn {

/// Where everybody is over time.
class People {
 public:
  /// Simulates everybody for as long as the robot drives. Who walks is drawn to a place chosen at random,
  /// keeps off walls, the others and the robot (Helbing & Molnar, "Social force model for pedestrian
  /// dynamics", 1995), and chooses another place when there; whom the robot reaches all the same, steps
  /// aside. Who stands, stands where the robot never comes near.
  People(const World& world, const Trajectory& robot, std::uint64_t seed);

  /// Everybody at that time, as lasers see them.
  std::vector<Cylinder> at(double time_s) const;

  std::size_t count() const { return frames_.empty() ? 0 : frames_.front().size() + standing_.size(); }

 private:
  void place_standing(const World& world, const Trajectory& robot, std::uint64_t seed);
  void walk(const World& world, const Trajectory& robot, std::uint64_t seed);
  void add_crowd(double time_s, std::vector<Cylinder>& all) const;

  WorldPeopleOptions options_;
  Trajectory robot_;
  std::vector<Point2> standing_;
  std::vector<std::vector<Point2>> frames_;  ///< of who walks, kFrame_s apart
};

}  // namespace cairn
