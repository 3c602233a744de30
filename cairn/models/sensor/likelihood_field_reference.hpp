#pragma once

#include "cairn/models/sensor/likelihood_field.hpp"

#include <memory>

namespace cairn {

/// LikelihoodField in plain double precision, one beam after the other, as the formula stands there: slow,
/// the oracle of the fast one.
class LikelihoodFieldReference final : public LaserModel {
 public:
  LikelihoodFieldReference(std::shared_ptr<const DistanceField> field, const Pose2& T_base_sensor,
                           const BeamLimits& limits, const LikelihoodFieldOptions& options);

  BoundUpdate<Pose2> bind(const LaserScan& scan) const override;
  double explained_share(const LaserScan& scan, const Pose2& T_map_base) const override;

 private:
  std::shared_ptr<const DistanceField> field_;
  Pose2 T_base_sensor_;
  BeamLimits limits_;
  LikelihoodFieldOptions options_;
};

}  // namespace cairn
