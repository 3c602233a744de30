#pragma once

#include "cairn/bayes/models.hpp"
#include "cairn/core/pose2.hpp"

#include <Eigen/Core>

namespace cairn {

/// How far around a pose its local posterior is looked at, at most.
struct LocalPosteriorOptions {
  double reach_m = 0.5;     ///< half side of the square of positions
  double reach_rad = 0.17;  ///< to either side of the heading
};

/// One mode of a posterior over poses under a uniform prior.
struct LocalPosterior {
  Pose2 mean;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x, y, theta) in the map frame: m, rad
  /// Log of the likelihood's integral around the mode (m^2 rad): what weighs it against other modes.
  double log_mass = 0.0;
  double largest = 0.0;  ///< log-likelihood of the best pose tried
};

/// Integrates a likelihood around a pose, on a lattice of 9 x 9 x 9 poses that is fitted to it five times:
/// from the widest reach to 3 standard deviations along its own axes. Deterministic; 3645 evaluations.
LocalPosterior local_posterior(const BoundUpdate<Pose2>& z, const Pose2& around,
                               const LocalPosteriorOptions& options);

}  // namespace cairn
