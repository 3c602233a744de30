#pragma once

#include "cairn/core/options.hpp"
#include "cairn/core/pose2.hpp"
#include "cairn/maps/distance_field.hpp"
#include "cairn/models/sensor/beam_selection.hpp"
#include "cairn/models/sensor/laser_model.hpp"
#include "cairn/models/sensor/likelihood_plane.hpp"
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

  /// log(z_hit exp(-d^2 / (2 sigma_hit^2)) + z_rand): of one beam that ends at distance d from a wall.
  double log_likelihood(double distance_m) const;
  /// min(1, effective_beams / beams): the share with which each of so many beams counts.
  double share_of(std::size_t beams) const;
  /// A beam that ends so close to a wall is explained by the map: 3 sigma_hit.
  double explained_within_m() const { return 3.0 * sigma_hit_m; }
};

/// Likelihood field for range finders, the true product over the beams (Thrun et al., Probabilistic Robotics,
/// table 6.3; AMCL's `likelihood_field_prob`):
///   log p(z | x) = s * sum_k log(z_hit exp(-d_k^2 / (2 sigma_hit^2)) + z_rand),  s = min(1, effective_beams
///   / K)
/// where d_k is the distance from the end point of beam k to the nearest occupied cell. Neighbouring beams
/// see the same wall and the same map errors, so a scan of K beams holds fewer than K independent facts: the
/// exponent s says how many. Where no occupied cell is near, and off the map, d_k is `max_distance_m`.
///
/// The log-likelihoods of the cells are held in 255 steps, or in 65535 if the steps would show (when a scan
/// counts for several hundred beams, or z_rand is tiny), and positions as floats: the score differs from that
/// of LikelihoodFieldReference by less than 0.05 nat in the mean, 0.35 in one pose of a hundred. Every path
/// of simd.hpp gives the same bytes. Memory: 1 or 2 bytes and a bit per cell.
class LikelihoodField final : public LaserModel {
 public:
  /// @param T_base_sensor where the scanner sits on the robot
  /// @param field only read, not kept
  LikelihoodField(const std::shared_ptr<const DistanceField>& field, const Pose2& T_base_sensor,
                  const BeamLimits& limits, const LikelihoodFieldOptions& options);

  /// States are T_map_base. A scan without a valid beam gives 0 everywhere; a state that is not finite scores
  /// as one far off the map. The gradient is that of the score interpolated between the cells' centres
  /// (LikelihoodPlane::interpolate): the score itself is flat within each cell.
  BoundUpdate<Pose2> bind(const LaserScan& scan) const override;

  /// Share of the evaluated beams that end within 3 sigma_hit of a wall, seen from `T_map_base`: 0..1.
  double explained_share(const LaserScan& scan, const Pose2& T_map_base) const override;

 private:
  class NearWalls;
  std::shared_ptr<const LikelihoodPlane> plane_;
  std::shared_ptr<const NearWalls> near_walls_;
  Pose2 T_base_sensor_;
  BeamLimits limits_;
  LikelihoodFieldOptions options_;
};

}  // namespace cairn
