#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/maps/distance_field.hpp"
#include "cairn/models/sensor/beam_classes.hpp"
#include "cairn/models/sensor/scan_matching.hpp"

#include <memory>

namespace cairn {

struct PlaceFitOptions {
  double reach_m = 0.1;  ///< how far a place moves with one scan, standard deviation of the prior
  double reach_rad = 0.05;
  int iterations = 3;
  int max_beams = 40;  ///< that a place is moved by
  /// What a beam that passes through a wall costs beyond one that ends before it, nat. At right poses there
  /// are 5 to 10 times more of the latter: people and things that the map does not know.
  double beyond = 1.7;
};

/// How well a scan fits where a robot may be, to compare places by: beams that end beside walls, those that
/// do not, and those that pass through walls, which end points alone do not tell. Immutable.
class PlaceFit {
 public:
  PlaceFit(std::shared_ptr<const BeamClassifier> classes, std::shared_ptr<const DistanceField> walls,
           const Pose2& T_base_sensor, const BeamLimits& limits, const PlaceFitOptions& options = {});

  /// Moves the place T_map_base to where the scan fits best nearby (iterated Kalman update of a prior around
  /// it). Returns the log-likelihood per beam there, 0 for the best possible scan; 0 for one without a beam.
  double follow(const LaserScan& scan, Pose2& T_map_base) const;

 private:
  std::shared_ptr<const BeamClassifier> classes_;
  ScanMatching matching_;
  PlaceFitOptions options_;
};

}  // namespace cairn
