#pragma once

#include "cairn/maps/wall_distance.hpp"
#include "cairn/models/sensor/laser_model.hpp"
#include "cairn/models/sensor/likelihood_field.hpp"

#include <memory>

namespace cairn {

/// Likelihood of the end points of a scan against the segments of a vector map: the likelihood field (Thrun
/// et al., Probabilistic Robotics, table 6.3) with exact distances in place of a grid's,
///   log p(z | x) = s * sum_k log(z_hit exp(-d_k^2 / (2 sigma_hit^2)) + z_rand),  s = min(1, effective_beams
///   / K)
/// where d_k is the distance of end point k to the nearest wall, max_distance_m where none is that near. The
/// gradient is that of this formula.
class VectorAmcl final : public LaserModel {
 public:
  /// @param T_base_sensor where the scanner sits on the robot
  VectorAmcl(std::shared_ptr<const WallDistance> walls, const Pose2& T_base_sensor, const BeamLimits& limits,
             const LikelihoodFieldOptions& options);

  /// States are T_map_base. A scan without a valid beam gives 0 everywhere; a state that is not finite scores
  /// as one far off the map.
  BoundUpdate<Pose2> bind(const LaserScan& scan) const override;

  /// Share of the evaluated beams that end within 3 sigma_hit of a wall.
  double explained_share(const LaserScan& scan, const Pose2& T_map_base) const override;

 private:
  std::shared_ptr<const WallDistance> walls_;
  Pose2 T_base_sensor_;
  BeamLimits limits_;
  LikelihoodFieldOptions options_;
};

}  // namespace cairn
