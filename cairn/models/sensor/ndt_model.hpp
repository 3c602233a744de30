#pragma once

#include "cairn/core/options.hpp"
#include "cairn/maps/ndt_map.hpp"
#include "cairn/models/sensor/beam_selection.hpp"
#include "cairn/models/sensor/laser_model.hpp"

#include <memory>

namespace cairn {

struct NdtModelOptions {
  double cell_size_m = 0.5;       ///< of the map, where it is derived from a grid
  double z_hit = 0.85;            ///< weight of "the beam ended at a wall of the map"
  double z_rand = 0.15;           ///< weight of "the beam ended anywhere"
  double sigma_hit_m = 0.05;      ///< noise of the end points, added to the distributions of the map
  int max_beams = 60;             ///< evaluated beams, spread evenly over the valid ones; 0: all
  double effective_beams = 20.0;  ///< a scan never counts for more than this many independent beams

  void visit(OptionVisitor& visitor);
};

/// Whether the occupancy of a distribution counts: ONDT, or plain NDT.
enum class NdtKind { kNdt, kOndt };

/// End points against the normal distributions of the walls (NDT: Saarinen et al., "Normal Distributions
/// Transform Monte-Carlo Localization", IROS 2013; ONDT: Schulz, Hanten & Zell, IROS 2018):
///   f(p) = 1/4 sum_c w_c exp(-1/2 (p - mean_c)' (cov_c + sigma_hit^2 I)^-1 (p - mean_c))
///   log p(z | x) = s * sum_k log(z_hit f(p_k) + z_rand),  s = min(1, effective_beams / K)
/// over the four cells c around the end point p_k of beam k; w_c is the occupancy (ONDT) or 1 (NDT). Where
/// no distribution is, and off the map, f is 0.
class NdtModel final : public LaserModel {
 public:
  NdtModel(std::shared_ptr<const NdtMap> map, NdtKind kind, const Pose2& T_base_sensor,
           const BeamLimits& limits, const NdtModelOptions& options);

  /// A scan without a valid beam gives 0 everywhere; a state that is not finite scores as one far off the
  /// map.
  BoundUpdate<Pose2> bind(const LaserScan& scan) const override;

  /// Explained: ends within 3 standard deviations of one of the four distributions.
  double explained_share(const LaserScan& scan, const Pose2& T_map_base) const override;

 private:
  struct Table;
  struct Beams;
  std::shared_ptr<const Table> table_;
  Pose2 T_base_sensor_;
  BeamLimits limits_;
  NdtModelOptions options_;
};

}  // namespace cairn
