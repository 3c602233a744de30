#pragma once

#include "cairn/core/options.hpp"
#include "cairn/maps/visibility.hpp"
#include "cairn/models/sensor/beam_selection.hpp"
#include "cairn/models/sensor/laser_model.hpp"

#include <memory>

namespace cairn {

struct VectorLaserOptions {
  double sigma_m = 0.05;        ///< distance of end points to the wall that is seen there, standard deviation
  double obstacle_m = 0.15;     ///< a beam that ends before its wall counts for no more than this far off it
  double short_hit_m = 0.15;    ///< likewise one that ends behind its wall
  double out_of_range_m = 0.2;  ///< likewise one in whose direction the map has no wall
  double margin_m = 0.1;        ///< end points correspond to walls that are seen within this to their sides
  double gate_m = 0.5;          ///< the gradient uses end points up to this far off their wall
  double gate_rad =
      0.5235987755982988;         ///< and this much between the directions of scan and wall (30 degrees)
  int max_beams = 90;             ///< evaluated beams, spread evenly over the valid ones; 0: all
  double effective_beams = 20.0;  ///< a scan never counts for more than this many independent beams

  void visit(OptionVisitor& visitor);
};

/// Laser scans against a vector map, as corrective gradient refinement sees them (Biswas, Coltin & Veloso,
/// "Corrective Gradient Refinement for Mobile Robot Localization", IROS 2011; Biswas & Veloso,
/// "Multi-Sensor Mobile Robot Localization for Diverse Environments", 2.1).
///
/// The scene is rendered from the pose of the scanner; a beam corresponds to the nearest piece of a wall
/// among those that are seen in its direction, margin_m to both sides. With d_k, the distance of its end
/// point to that piece,
///   log p(z | x) = s * sum_k log(exp(-d_k^2 / (2 sigma^2)) + exp(-c_k^2 / (2 sigma^2)))
/// where c_k is obstacle_m before the wall, short_hit_m behind it, and a beam without a wall counts as
/// out_of_range_m off one; s = min(1, effective_beams / K) since the K beams are not independent.
///
/// The gradient takes the pose as the only variable, the correspondences as fixed, and only those whose point
/// lies near its wall and whose neighbours in the scan run along it (gate_m, gate_rad).
///
/// The published code has sigma 0.03 m, obstacle 0.8 m, short hit 1.5 m, out of range 4 m and s = 1/80000:
/// almost all of the weight then is how many beams are blocked. The defaults here make each beam worth a few
/// nats at most, so that s need not be that small.
class VectorLaser final : public LaserModel {
 public:
  /// @param T_base_sensor where the scanner sits on the robot
  VectorLaser(std::shared_ptr<const WallGrid> walls, const Pose2& T_base_sensor, const BeamLimits& limits,
              const VectorLaserOptions& options);

  /// States are T_map_base. A scan without a valid beam gives 0 everywhere; a state that is not finite scores
  /// as one that sees no wall.
  BoundUpdate<Pose2> bind(const LaserScan& scan) const override;

  /// Share of the evaluated beams that end within 0.15 m of the wall that is seen there.
  double explained_share(const LaserScan& scan, const Pose2& T_map_base) const override;

 private:
  std::shared_ptr<const WallGrid> walls_;
  Pose2 T_base_sensor_;
  BeamLimits limits_;
  VectorLaserOptions options_;
};

}  // namespace cairn
