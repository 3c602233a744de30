#pragma once

#include "cairn/core/options.hpp"
#include "cairn/maps/ray_marching.hpp"
#include "cairn/models/sensor/beam_selection.hpp"
#include "cairn/models/sensor/laser_model.hpp"

#include <memory>

namespace cairn {

/// The four causes of a range reading. The weights need not add up to 1: only their shares count.
struct BeamModelOptions {
  double z_hit = 0.85;   ///< the wall of the map, with noise
  double z_short = 0.1;  ///< something in front of it
  double z_max = 0.02;   ///< no return
  double z_rand = 0.03;  ///< anything
  double sigma_hit_m = 0.1;
  double lambda_short_per_m = 0.3;  ///< how quickly short readings become rare with distance, 1/m
  int max_beams = 60;               ///< evaluated beams, spread evenly over the usable ones; 0: all
  double effective_beams = 20.0;    ///< a scan never counts for more than this many independent beams

  void visit(OptionVisitor& visitor);
};

/// p(z | r) of one beam (Thrun et al., Probabilistic Robotics, table 6.1), with r the range of the map:
///   z < z_max:  z_hit N(z; r, sigma) + z_short lambda exp(-lambda z) / (1 - exp(-lambda r)) [z <= r]
///               + z_rand / z_max                                               a density, 1/m
///   z >= z_max: z_max + z_hit P(N(r, sigma) >= z_max)                          a probability
/// The book cuts the Gaussian off at z_max and scales up what is left of it; here what is cut off is a
/// reading without return, which is what a scanner makes of a wall just beyond its reach. A density in some
/// states is never compared with a probability in others: which of the two it is depends on z alone.
class BeamMixture {
 public:
  /// @param max_range_m z_max: readings from here on are no returns
  BeamMixture(const BeamModelOptions& options, double max_range_m);

  /// The four terms of p(z | r), each with its weight; their sum is p(z | r).
  struct Terms {
    double hit, unexpected, max, rand;
    double sum() const { return hit + unexpected + max + rand; }
  };
  Terms terms(double z_m, double expected_m) const;
  double log_likelihood(double z_m, double expected_m) const;

  double max_range_m() const { return max_range_m_; }

 private:
  double hit_, short_, max_, rand_;
  double sigma_m_, lambda_per_m_, max_range_m_;
};

/// The ranges r that a map lets a sensor expect, laid out as by RayMarcher::cast; `map.max_range_m()` where a
/// ray meets nothing. A ray ends at the front of an occupied cell, but the wall that made it occupied went
/// through it somewhere: on average half a cell further on. Without that a laser that looks one way sits half
/// a cell too far back: 2.5 cm with cells of 5 cm.
void expect_ranges(const RayMarcher& map, std::span<const Pose2> T_map_sensor,
                   std::span<const double> bearings_rad, std::span<float> ranges_m);

/// Beam model of range finders: a mixture per beam on the range that a ray cast into the map meets.
///   log p(z | x) = s * sum_k log p(z_k | r_k(x)),  s = min(1, effective_beams / K)
/// Beams that tell no range but do not say "nothing within reach" (NaN, zero, below the least range) are left
/// out; infinite ones and those from the largest range on are readings without return. A scan without usable
/// beam gives 0 everywhere. Rays pass through unknown cells and end at occupied ones.
class BeamModel final : public LaserModel {
 public:
  BeamModel(std::shared_ptr<const RayMarcher> map, const Pose2& T_base_sensor, const BeamLimits& limits,
            const BeamModelOptions& options);

  BoundUpdate<Pose2> bind(const LaserScan& scan) const override;

  /// Explained: within 3 sigma_hit (at least 0.15 m) of the map's range, or no return where the map's
  /// range is beyond reach.
  double explained_share(const LaserScan& scan, const Pose2& T_map_base) const override;

  bool reads_no_returns() const override { return true; }

 private:
  class NormalTail;
  class Beams;
  std::shared_ptr<const RayMarcher> map_;
  std::shared_ptr<const NormalTail> tail_;
  Pose2 T_base_sensor_;
  BeamLimits limits_;
  BeamModelOptions options_;
};

}  // namespace cairn
