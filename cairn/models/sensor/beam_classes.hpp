#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/maps/distance_field.hpp"
#include "cairn/maps/occupancy_grid.hpp"
#include "cairn/maps/ray_marching.hpp"
#include "cairn/models/sensor/beam_selection.hpp"
#include "cairn/sensing/laser_scan.hpp"

#include <memory>

namespace cairn {

/// How the beams of one scan stand to the map, seen from one pose. The shares and `unknown` sum to 1.
struct BeamShares {
  double explained = 0.0;  ///< ends beside a wall of the map, or where the map leads to expect it
  double blocked = 0.0;    ///< ends before the expected wall, at nothing that the map knows: an obstacle
  double beyond = 0.0;     ///< ends in free space behind the expected wall: it passed through a wall
  double unknown = 0.0;    ///< ends where the map knows nothing
  double fit = 0.0;        ///< mean over the beams of log(0.85 exp(-d^2 / (2 sigma^2)) + 0.15), d to the wall
  int beams = 0;           ///< that were looked at; 0: the scan says nothing
  /// If so: share of its beams for which the map leads to expect a wall within reach.
  double missing = 0.0;
  /// Mean over the beams of d^2 / (2 sigma^2), at most 2, of the explained ones; 0 for the others.
  double residual = 0.0;
};

/// The shares among the beams that end where the map knows something: what is off the map says nothing then.
/// 0 beams if hardly one is left.
BeamShares on_the_map(const BeamShares& seen);

struct BeamClassOptions {
  int beams = 60;                ///< looked at, spread evenly over the valid ones
  double tolerance_m = 0.15;     ///< of the end point, or of the range
  double tolerance_rad = 0.015;  ///< likewise, per metre of range: error of the heading
  double sigma_m = 0.1;          ///< of `fit`
};

/// Tells what the map knows from what it does not (after Fox, Burgard & Thrun, "Markov Localization for
/// Mobile Robots in Dynamic Environments", JAIR 1999, section 3.3: readings that are unexpectedly short come
/// from people, and must not speak against the pose). People and carts block beams; only a wrong pose, or a
/// wall that is gone, lets them through walls. That is what tells a crowd from a wrong place.
///
/// Beams without return are left out: glass and black surfaces give none either. Immutable.
class BeamClassifier {
 public:
  BeamClassifier(std::shared_ptr<const OccupancyGrid> map, std::shared_ptr<const DistanceField> walls,
                 std::shared_ptr<const RayMarcher> rays, const Pose2& T_base_sensor, const BeamLimits& limits,
                 const BeamClassOptions& options = {});

  BeamShares classify(const LaserScan& scan, const Pose2& T_map_base) const;

 private:
  enum class Class { kExplained, kBlocked, kBeyond, kUnknown };
  Class class_of(double range_m, double expected_m, const Point2& end) const;
  double share_within_reach(const LaserScan& scan, const Pose2& T_map_sensor) const;
  double wall_distance_m(const Point2& p) const;

  std::shared_ptr<const OccupancyGrid> map_;
  std::shared_ptr<const DistanceField> walls_;
  std::shared_ptr<const RayMarcher> rays_;
  Pose2 T_base_sensor_;
  BeamLimits limits_;
  BeamClassOptions options_;
};

}  // namespace cairn
