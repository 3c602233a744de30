#include "cairn/bayes/pose_kernel.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/statistics.hpp"

#include <cmath>
#include <vector>

namespace cairn {

void PoseKernelOptions::visit(OptionVisitor& v) {
  v.number({"width", "standard deviation of the moves as a share of the particles' own"}, width, {0.0, 1.0});
  v.number({"largest_spread_m", "particles spread wider than this are not moved, metres"}, largest_spread_m,
           {0.0, 1e6});
}

bool PoseKernel::fit(const ParticleSet<Pose2>& particles) {
  std::vector<double> weights(particles.size());
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = std::exp(particles.log_weights[i]);
  const Eigen::Matrix3d covariance = weighted_moments(particles.states, weights).covariance;
  if (std::sqrt(covariance(0, 0) + covariance(1, 1)) > options_.largest_spread_m) return false;
  sigma_ = {options_.width * std::sqrt(covariance(0, 0)), options_.width * std::sqrt(covariance(1, 1)),
            options_.width * std::sqrt(covariance(2, 2))};
  return true;
}

void PoseKernel::move(std::span<Pose2> states, const RandomStream& random, std::uint16_t draw) const {
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto n = random.normal4(static_cast<std::uint32_t>(i), draw);
    states[i] = {states[i].x + sigma_.x * n[0], states[i].y + sigma_.y * n[1],
                 normalize_angle(states[i].theta + sigma_.theta * n[2])};
  }
}

}  // namespace cairn
