#pragma once

#include "cairn/core/options.hpp"
#include "cairn/maps/distance_field.hpp"
#include "cairn/models/sensor/beam_selection.hpp"
#include "cairn/sensing/laser_scan.hpp"

#include <memory>
#include <span>

namespace cairn {

struct BeamSkippingOptions {
  bool use = false;
  double distance_m = 0.5;       ///< a beam that ends within this of a wall fits the map
  double threshold = 0.3;        ///< beams that fit in this share of the belief or less are left out
  double error_threshold = 0.9;  ///< if this share of the beams would be left out, none is

  void visit(OptionVisitor& visitor);
};

/// Takes from a scan the beams that dynamic obstacles stop (AMCL's `do_beamskip`, for any sensor model): a
/// beam whose end point is near a wall in hardly any state of the belief saw something that is not on the
/// map. Where nearly all beams are such, it is the belief that is wrong: they all stay, so that this can be
/// found out.
///
/// AMCL evaluates what is left of its evenly spread beams; here a model chooses as many as ever among the
/// beams of the whole scan that are left. Beams without a return are left to the model.
class BeamSkipping {
 public:
  BeamSkipping(std::shared_ptr<const DistanceField> field, const Pose2& T_base_sensor,
               const BeamLimits& limits, const BeamSkippingOptions& options);

  /// The scan with NaN (no information) in place of the beams that are left out.
  /// @param belief a sample of it, T_map_base; none: the scan as it is
  LaserScan expected_part(const LaserScan& scan, std::span<const Pose2> belief) const;

 private:
  std::shared_ptr<const DistanceField> field_;
  Pose2 T_base_sensor_;
  BeamLimits limits_;
  BeamSkippingOptions options_;
};

}  // namespace cairn
