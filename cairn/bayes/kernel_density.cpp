#include "cairn/bayes/kernel_density.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/statistics.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace cairn {
namespace {

constexpr double kLeast = 1e-3;  // standard deviation, metres and radians
constexpr double kFurthest = 722.0;

}  // namespace

KernelDensity::KernelDensity(std::span<const Pose2> poses, std::span<const double> log_weights, double factor)
    : log_weights_(log_weights.begin(), log_weights.end()) {
  std::vector<double> weights(log_weights.size());
  std::transform(log_weights.begin(), log_weights.end(), weights.begin(),
                 [](double w) { return std::exp(w); });
  const PoseMoments moments = weighted_moments(poses, weights);
  mean_ = moments.mean;
  const double n = effective_sample_size(log_weights);
  const double h = std::min(1.0, factor * std::pow(4.0 / (5.0 * n), 1.0 / 7.0));
  const Eigen::Matrix3d covariance =
      h * h * moments.covariance + kLeast * kLeast * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d root = covariance.llt().matrixL();
  whitening_ = root.triangularView<Eigen::Lower>().solve(Eigen::Matrix3d::Identity());
  const double drawn = std::sqrt(1.0 - h * h);
  for (const Pose2& pose : poses) centers_.emplace_back(drawn * whitened(pose));
}

Eigen::Vector3d KernelDensity::whitened(const Pose2& pose) const {
  return whitening_ *
         Eigen::Vector3d(pose.x - mean_.x, pose.y - mean_.y, normalize_angle(pose.theta - mean_.theta));
}

std::vector<double> KernelDensity::log_density(std::span<const Pose2> at) const {
  std::vector<double> densities, terms(centers_.size());
  densities.reserve(at.size());
  for (const Pose2& pose : at) {
    const Eigen::Vector3d x = whitened(pose);
    for (std::size_t j = 0; j < centers_.size(); ++j) {
      terms[j] = log_weights_[j] - std::min(0.5 * (x - centers_[j]).squaredNorm(), kFurthest);
    }
    densities.push_back(log_sum_exp(terms));
  }
  return densities;
}

}  // namespace cairn
