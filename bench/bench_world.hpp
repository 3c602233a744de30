#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/maps/occupancy_grid.hpp"
#include "cairn/sensing/laser_scan.hpp"

#include <memory>
#include <vector>

namespace cairn::bench {

/// What all benchmarks work on: a map of 50 m x 50 m in cells of 5 cm (rooms of 10 m with doors), a robot in
/// it, and the scan of 60 beams all around that it sees there. The sensor sits at the robot's origin.
struct BenchWorld {
  std::shared_ptr<const OccupancyGrid> map;
  Pose2 T_map_base;
  LaserScan scan;
};

const BenchWorld& bench_world();

/// A map of such rooms, `side` cells of 5 cm long and wide.
std::shared_ptr<const OccupancyGrid> square_map(int side);

/// Particles around the robot: 0.2 m and 0.1 rad standard deviation.
std::vector<Pose2> tracking_particles(std::size_t count);
/// Particles anywhere on the map.
std::vector<Pose2> global_particles(std::size_t count);

}  // namespace cairn::bench
