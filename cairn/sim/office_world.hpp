#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/sim/floor_plan.hpp"

#include <cstdint>
#include <vector>

namespace cairn {

/// Sizes of a generated office, metres. All walls lie on multiples of 5 cm.
struct OfficeOptions {
  int rooms_per_side = 5;
  double corridor_width_m = 2.4;
  double wall_thickness_m = 0.15;
  double door_width_m = 1.0;
  double min_room_width_m = 3.6;
  double max_room_width_m = 6.4;
  double min_room_depth_m = 4.0;
  double max_room_depth_m = 6.0;
  int furniture_per_room = 3;
  int people = 6;
  double clearance_m = 0.55;  ///< between the tour's line and any furniture or person

  void validate() const;  ///< @throws ConfigurationError for sizes with which no office can be built
};

/// An office along a corridor: rooms of different sizes on both sides, doors open, desks and shelves (boxes
/// that the map knows), people who stand still (cylinders that the map does not know), and a tour through all
/// rooms.
struct OfficeWorld {
  FloorPlan building;            ///< walls and furniture: what the map shows
  std::vector<Cylinder> people;  ///< not on the map
  std::vector<Rectangle> rooms;  ///< first the northern side, west to east, then the southern
  Pose2 start;                   ///< in the corridor's west end, looking east
  std::vector<Point2> tour;      ///< from `start` through every room and back to `start`
};

/// The same options and seed give the same office.
/// @throws ConfigurationError see OfficeOptions::validate
OfficeWorld make_office(const OfficeOptions& options, std::uint64_t seed);

}  // namespace cairn
