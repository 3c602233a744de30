#pragma once

#include "cairn/bayes/models.hpp"
#include "cairn/models/search/place_index.hpp"
#include "cairn/sensing/laser_scan.hpp"

#include <memory>
#include <mutex>

namespace cairn {

/// Samples of p(x | z) for a laser scanner: the capability that BoundUpdate::sample offers to recipes that
/// reset (cairn/bayes/injections).
///
/// The neighbours of a scan's signature give a density over poses that is constant on each cell of the place
/// index. Candidates drawn from it are weighed by likelihood over density (importance sampling), in portions
/// between which they are drawn again and moved a little, so that the samples are those of the likelihood
/// under a uniform prior, as far as the neighbours reach, and as exact as their number allows.
class PlaceSampler {
 public:
  /// @param index null: it is built when it is first needed, which takes seconds, for the field of view of
  /// the scan
  PlaceSampler(std::shared_ptr<const OccupancyGrid> map, std::shared_ptr<const PlaceIndex> index,
               const Pose2& T_base_sensor, const BeamLimits& limits);

  /// @param log_likelihood of the scan, as the sensor model binds it
  BoundUpdate<Pose2>::Sample bind(std::shared_ptr<const LaserScan> scan,
                                  BoundUpdate<Pose2>::LogLikelihood log_likelihood) const;

  /// The shape for which an index serves scans like this one.
  static SignatureShape shape_of(const LaserScan& scan);

 private:
  struct Shared;
  std::shared_ptr<const Shared> shared_;
};

}  // namespace cairn
