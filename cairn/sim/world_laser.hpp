#pragma once

#include "cairn/core/trajectory.hpp"
#include "cairn/maps/wall_grid.hpp"
#include "cairn/sensing/laser_scan.hpp"
#include "cairn/sim/people.hpp"
#include "cairn/sim/world.hpp"
#include "cairn/sim/world_scene.hpp"

#include <cstdint>
#include <optional>

namespace cairn {

/// True where a surface sends light back to where it came from: glass within 10 degrees of its normal, mesh
/// for every other number drawn, a mirror never.
/// @param mesh_draw  uniform number that decides at meshes
bool returns_light(const WorldScene::Surface& surface, double incidence_rad, double mesh_draw);

/// What a laser beam meets in a world at one instant: walls, closed doors and people.
class BeamCaster {
 public:
  /// @param walls  of world.solid, for all materials
  /// @param height_m  of the beams above the floor: what is lower, or hangs above, is not met
  BeamCaster(const World& world, const WallGrid& walls, const People& people, double time_s,
             double height_m = 0.3);

  struct Return {
    double range_m = 0.0;  ///< along the beam, mirrors included
    double incidence_rad = 0.0;
  };
  /// Where a beam is returned. Glass returns beams within 10 degrees of its normal and lets all others
  /// through, mesh returns every other one, a mirror reflects (at most four times).
  /// @param mesh_draw  uniform number that decides at meshes
  std::optional<Return> cast(const Point2& origin, double angle_rad, double max_range_m,
                             double mesh_draw) const;

 private:
  WorldScene scene_;
  double height_m_;
};

/// The scan that a laser of the options takes from `measured` on. While the laser sweeps the robot moves on:
/// each beam is measured from where the laser is then.
/// @param index  of the measurement: scans of different stream or index have independent noise
LaserScan simulate_world_scan(const World& world, const WallGrid& walls, const People& people,
                              const Trajectory& truth, const WorldLaserOptions& options, Time measured,
                              std::size_t stream, std::uint64_t index, std::uint64_t seed);

}  // namespace cairn
