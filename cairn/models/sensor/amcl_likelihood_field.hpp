#pragma once

#include "cairn/maps/distance_field.hpp"
#include "cairn/models/sensor/beam_selection.hpp"
#include "cairn/models/sensor/laser_model.hpp"
#include "cairn/models/sensor/likelihood_field.hpp"

#include <memory>

namespace cairn {

/// The weight of AMCL's model `likelihood_field`, for comparison:
///   log p(z | x) = log(1 + sum_k p_k^3),  p_k = z_hit exp(-d_k^2 / (2 sigma_hit^2)) + z_rand / range_max
/// It is no likelihood (beams add up, they do not multiply), and so forgives anything: a scan of 60 beams
/// moves the weights by a factor of about 40 at most. `effective_beams` has no meaning here.
class AmclLikelihoodField final : public LaserModel {
 public:
  AmclLikelihoodField(std::shared_ptr<const DistanceField> field, const Pose2& T_base_sensor,
                      const BeamLimits& limits, const LikelihoodFieldOptions& options);

  /// A scan without a valid beam gives 0 everywhere; a state that is not finite scores as one far off the
  /// map.
  BoundUpdate<Pose2> bind(const LaserScan& scan) const override;

  /// Explained: ends within 3 sigma_hit of a wall.
  double explained_share(const LaserScan& scan, const Pose2& T_map_base) const override;

 private:
  std::shared_ptr<const DistanceField> field_;
  Pose2 T_base_sensor_;
  BeamLimits limits_;
  LikelihoodFieldOptions options_;
};

}  // namespace cairn
