#include "cairn/bayes/pose_kernel.hpp"

#include "cairn/bayes/clustering.hpp"
#include "cairn/core/angle.hpp"
#include "cairn/core/batch_math.hpp"
#include "cairn/core/normal_batch.hpp"
#include "cairn/core/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {

void PoseKernelOptions::visit(OptionVisitor& v) {
  v.number({"width", "standard deviation of the moves as a share of the particles' own"}, width, {0.0, 1.0});
  v.number({"largest_spread_m", "particles spread wider than this are not moved, metres"}, largest_spread_m,
           {0.0, 1e6});
  v.number({"min_weight", "a compact group holds at least this share of the belief"}, min_weight, {0.5, 1.0});
  v.number({"wide_m", "standard deviation of the moves in position while the belief is not compact, metres"},
           wide_m, {0.0, 10.0});
  v.number({"wide_rad", "likewise of the heading, radians"}, wide_rad, {0.0, 3.2});
}

bool PoseKernel::fit(const ParticleSet<Pose2>& particles) {
  weights_ = particles.weights;
  if (weights_.size() != particles.size()) {
    weights_.resize(particles.size());
    exp_all(particles.log_weights, 0.0, weights_);
  }
  const bool compact =
      fit_group(particles.states, weights_) || fit_heaviest_cluster(particles.states, weights_);
  if (!compact) sigma_ = {options_.wide_m, options_.wide_m, options_.wide_rad};
  return compact;
}

bool PoseKernel::fit_group(std::span<const Pose2> poses, std::span<const double> weights) {
  const Eigen::Matrix3d covariance = weighted_moments(poses, weights).covariance;
  sigma_ = {options_.width * std::sqrt(covariance(0, 0)), options_.width * std::sqrt(covariance(1, 1)),
            options_.width * std::sqrt(covariance(2, 2))};
  return std::sqrt(covariance(0, 0) + covariance(1, 1)) <= options_.largest_spread_m;
}

// A few stragglers far away must not keep the belief from counting as compact.
bool PoseKernel::fit_heaviest_cluster(std::span<const Pose2> poses, std::span<double> weights) {
  const Clusters clusters = cluster_poses(poses, weights, {});
  if (clusters.weight.empty() || clusters.weight[0] < options_.min_weight) return false;
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = clusters.label[i] == 0 ? weights[i] : 0.0;
  return fit_group(poses, weights);
}

void PoseKernel::move(std::span<Pose2> states, const RandomStream& random, std::uint16_t draw) const {
  NormalBatch noise;
  for (std::size_t begin = 0; begin < states.size(); begin += NormalBatch::kCapacity) {
    const std::size_t count = std::min(NormalBatch::kCapacity, states.size() - begin);
    noise.fill(random, static_cast<std::uint32_t>(begin), count, draw);
    for (std::size_t i = 0; i < count; ++i) {
      Pose2& state = states[begin + i];
      state = {state.x + sigma_.x * noise.number[0][i], state.y + sigma_.y * noise.number[1][i],
               normalize_angle(state.theta + sigma_.theta * noise.number[2][i])};
    }
  }
}

void PoseKernel::save(PartMemory& memory) const {
  for (const double sigma : {sigma_.x, sigma_.y, sigma_.theta}) memory.put(sigma);
}

void PoseKernel::load(PartMemory::Reader& memory) {
  for (double* sigma : {&sigma_.x, &sigma_.y, &sigma_.theta}) *sigma = memory.take();
}

}  // namespace cairn
