#include "cairn/localization/particle_pose_filter.hpp"

#include "cairn/bayes/clustering.hpp"
#include "cairn/bayes/resampling/systematic.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {

struct ParticlePoseFilter::FilterCheckpoint final : PoseFilter::Checkpoint {
  Filter::Checkpoint state;
};

void ParticlePoseFilter::predict(const PoseControl& control) {
  filter_.predict(control.T_before_after);
  if (control.unknown_s > 0.0) filter_.predict({}, RandomWalk(walk_, control.unknown_s));
}

PoseSummary ParticlePoseFilter::summarize() const {
  const ParticleSet<Pose2>& particles = filter_.particles();
  std::vector<double> weights = particles.weights;
  const Clusters clusters = cluster_poses(particles.states, weights, {});
  if (!clusters.weight.empty()) {
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = clusters.label[i] == 0 ? weights[i] : 0.0;
  }
  const PoseMoments moments = weighted_moments(particles.states, weights);
  return {.T_map_base = moments.mean,
          .covariance = moments.covariance,
          .ess = filter_.ess(),
          .particles = static_cast<int>(particles.size()),
          .hypotheses = std::max(1, static_cast<int>(clusters.weight.size())),
          .weight = clusters.weight.empty() ? 1.0 : clusters.weight[0]};
}

std::vector<Pose2> ParticlePoseFilter::sample(std::size_t at_most) const {
  const ParticleSet<Pose2>& particles = filter_.particles();
  const std::size_t count = std::min(at_most, particles.size());
  std::vector<Pose2> poses;
  if (count == 0) return poses;
  std::vector<std::uint32_t> chosen;
  std::vector<double> cumulative;
  cumulative_sums(particles.weights, cumulative);
  draw_systematic(cumulative, count, 0.5, chosen);
  for (const std::uint32_t i : chosen) poses.push_back(particles.states[i]);
  return poses;
}

std::unique_ptr<PoseFilter::Checkpoint> ParticlePoseFilter::new_checkpoint() const {
  return std::make_unique<FilterCheckpoint>();
}

void ParticlePoseFilter::save(Checkpoint& checkpoint) const {
  filter_.save(static_cast<FilterCheckpoint&>(checkpoint).state);
}

void ParticlePoseFilter::restore(const Checkpoint& checkpoint) {
  filter_.restore(static_cast<const FilterCheckpoint&>(checkpoint).state);
}

}  // namespace cairn
