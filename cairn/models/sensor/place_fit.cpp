#include "cairn/models/sensor/place_fit.hpp"

#include "cairn/core/angle.hpp"

#include <utility>

namespace cairn {
namespace {

double fit_of(const BeamShares& shares, const PlaceFitOptions& o) {
  return -(o.blocked * shares.blocked + o.beyond * shares.beyond + o.unknown * shares.unknown +
           o.residual * shares.residual);
}

}  // namespace

PlaceFit::PlaceFit(std::shared_ptr<const BeamClassifier> classes, std::shared_ptr<const DistanceField> walls,
                   const Pose2& T_base_sensor, const BeamLimits& limits, const PlaceFitOptions& options)
    : classes_(std::move(classes)),
      matching_(distance_to_cells(std::move(walls)), T_base_sensor, limits, {.max_beams = options.max_beams}),
      options_(options) {}

double PlaceFit::follow(const LaserScan& scan, Pose2& T_map_base) const {
  GaussianPose prior{T_map_base, {}};
  prior.covariance = Eigen::Vector3d(options_.reach_m, options_.reach_m, options_.reach_rad)
                         .array()
                         .square()
                         .matrix()
                         .asDiagonal();
  if (const auto moved = iterated_update(matching_, scan, prior, options_.iterations)) {
    // The way there may lead to a worse place where the walls bend: then it stays.
    const double before = fit_of(classes_->classify(scan, T_map_base), options_);
    const double after = fit_of(classes_->classify(scan, moved->mean), options_);
    if (after >= before) {
      T_map_base = moved->mean;
      T_map_base.theta = normalize_angle(T_map_base.theta);
      return after;
    }
    return before;
  }
  return fit_of(classes_->classify(scan, T_map_base), options_);
}

}  // namespace cairn
