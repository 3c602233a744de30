#pragma once

#include "cairn/core/pose2.hpp"

#include <span>

#include <Eigen/Core>

namespace cairn {

/// log(sum(exp(values))) without overflow or underflow; -infinity for an empty span or if all are -infinity.
double log_sum_exp(std::span<const double> values);

/// Turns log-weights of any offset into weights that sum to 1, in place (log-weights become log(w_i)).
/// Returns the log of the sum before. The values must be finite.
double normalize_log_weights(std::span<double> log_weights);

/// Effective sample size 1 / sum(w^2) of normalised log-weights (Liu 1996): 1..N.
double effective_sample_size(std::span<const double> normalized_log_weights);

/// Mean and covariance of weighted poses. Heading statistics are taken on the circle: the mean is the
/// direction of the resultant, deviations are shortest turns from it. Weights need not be normalised; their
/// sum must be > 0.
struct PoseMoments {
  Pose2 mean;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x, y, theta)
};
PoseMoments weighted_moments(std::span<const Pose2> poses, std::span<const double> weights);

/// Upper quantile z of the standard normal distribution: P(Z <= z) = probability, for 0 < probability < 1.
/// Relative error below 1.2e-9 (Acklam's rational approximation with one Halley step).
double normal_quantile(double probability);

}  // namespace cairn
