#include "cairn/localization/particle_pose_filter.hpp"

#include "cairn/bayes/hypotheses.hpp"
#include "cairn/bayes/resampling/systematic.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

// Finer than the groups that a filter keeps apart, so that a belief that is spread along a corridor is one
// long place; but means of cells rather than cells that touch, so that two headings at one place are two.
constexpr HypothesisOptions kPlaces{
    .cell_m = 1.0, .fuse_m = 1.5, .fuse_rad = 0.5, .fuse_sigmas = 0.0, .valley = 0.0};

}  // namespace

struct ParticlePoseFilter::FilterCheckpoint final : PoseFilter::Checkpoint {
  Filter::Checkpoint state;
};

void ParticlePoseFilter::predict(const PoseControl& control) {
  filter_.predict(control.T_before_after);
  if (control.unknown_s > 0.0) filter_.predict({}, RandomWalk(walk_, control.unknown_s));
}

PoseSummary ParticlePoseFilter::summarize() const {
  const ParticleSet<Pose2>& particles = filter_.particles();
  PoseHypotheses places = find_hypotheses(particles.states, particles.weights, kPlaces);
  const PoseHypothesis& heaviest = places.found.front();
  return {.T_map_base = heaviest.mean,
          .covariance = heaviest.covariance,
          .ess = filter_.ess(),
          .particles = static_cast<int>(particles.size()),
          .hypotheses = static_cast<int>(places.found.size()),
          .weight = heaviest.weight,
          .places = std::move(places.found)};
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
