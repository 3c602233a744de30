#pragma once

#include "cairn/core/options.hpp"
#include "cairn/core/pose2.hpp"
#include "cairn/maps/distance_field.hpp"
#include "cairn/models/sensor/beam_selection.hpp"
#include "cairn/models/sensor/laser_model.hpp"
#include "cairn/sensing/laser_scan.hpp"

#include <memory>

namespace cairn {

struct LikelihoodFieldOptions {
  double z_hit = 0.85;            ///< weight of "the beam ended at a wall of the map"
  double z_rand = 0.15;           ///< weight of "the beam ended anywhere"
  double sigma_hit_m = 0.05;      ///< distance of end points to the mapped wall, standard deviation
  double max_distance_m = 2.0;    ///< distances beyond count as this one
  int max_beams = 60;             ///< evaluated beams, spread evenly over the valid ones; 0: all
  double effective_beams = 20.0;  ///< a scan never counts for more than this many independent beams

  void visit(OptionVisitor& visitor);
};

/// Likelihood field for range finders, the true product over the beams (Thrun et al., Probabilistic Robotics,
/// table 6.3; AMCL's `likelihood_field_prob`):
///   log p(z | x) = s * sum_k log(z_hit exp(-d_k^2 / (2 sigma_hit^2)) + z_rand),  s = min(1, effective_beams
///   / K)
/// where d_k is the distance from the end point of beam k to the nearest occupied cell. Neighbouring beams
/// see the same wall and the same map errors, so a scan of K beams holds fewer than K independent facts: the
/// exponent s says how many. Where no occupied cell is near, and off the map, d_k is `max_distance_m`.
class LikelihoodField final : public LaserModel {
 public:
  /// @param T_base_sensor where the scanner sits on the robot
  LikelihoodField(std::shared_ptr<const DistanceField> field, const Pose2& T_base_sensor,
                  const BeamLimits& limits, const LikelihoodFieldOptions& options);

  /// States are T_map_base. A scan without a valid beam gives 0 everywhere; a state that is not finite scores
  /// as one far off the map.
  BoundUpdate<Pose2> bind(const LaserScan& scan) const override;

  /// Share of the evaluated beams that end within 3 sigma_hit of a wall, seen from `T_map_base`: 0..1.
  double explained_share(const LaserScan& scan, const Pose2& T_map_base) const override;

 private:
  struct Table;
  std::shared_ptr<const DistanceField> field_;
  std::shared_ptr<const Table> table_;
  Pose2 T_base_sensor_;
  BeamLimits limits_;
  LikelihoodFieldOptions options_;
};

}  // namespace cairn
