#pragma once

#include "cairn/core/pose2.hpp"

#include <span>
#include <vector>

#include <Eigen/Core>

namespace cairn {

/// Density of weighted poses by Gaussian kernels. Their covariance is that of the poses times h^2, with the
/// rule of thumb h = (4 / ((d + 2) n))^(1 / (d + 4)), d = 3, n the effective number of poses (Silverman 1986,
/// 4.3.2), at least a millimetre and a milliradian. The kernels stand on the poses drawn towards their mean
/// by sqrt(1 - h^2), so that the density has the covariance of the poses and not a larger one (West,
/// "Approximating Posterior Distributions by Mixture", 1993).
class KernelDensity {
 public:
  /// @param factor  times the rule of thumb
  KernelDensity(std::span<const Pose2> poses, std::span<const double> log_weights, double factor = 1.0);

  /// Logarithm of the density at each of `at`, up to a constant. Finite for finite poses: not below that of
  /// 38 widths off.
  std::vector<double> log_density(std::span<const Pose2> at) const;

 private:
  Eigen::Vector3d whitened(const Pose2& pose) const;

  Pose2 mean_;
  Eigen::Matrix3d whitening_;
  std::vector<Eigen::Vector3d> centers_;  ///< whitened
  std::vector<double> log_weights_;
};

}  // namespace cairn
