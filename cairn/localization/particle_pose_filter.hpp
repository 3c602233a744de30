#pragma once

#include "cairn/bayes/particle_filter.hpp"
#include "cairn/localization/pose_filter.hpp"
#include "cairn/models/motion/random_walk.hpp"

namespace cairn {

/// A particle filter over poses as a PoseFilter.
class ParticlePoseFilter final : public PoseFilter {
 public:
  using Filter = ParticleFilter<Pose2, Pose2>;

  /// @param walk how the particles stray while there is no odometry
  ParticlePoseFilter(Filter filter, const RandomWalkOptions& walk)
      : filter_(std::move(filter)), walk_(walk) {}

  void initialize(const Sampler& sample) override { filter_.initialize(sample); }
  void predict(const PoseControl& control) override;
  void correct(const BoundUpdate<Pose2>& z) override { filter_.correct(z); }
  bool compact() const override { return filter_.compact(); }
  std::size_t size() const override { return filter_.particles().size(); }
  /// Of the heaviest place, with all others (find_hypotheses).
  PoseSummary summarize() const override;
  std::vector<Pose2> sample(std::size_t at_most) const override;
  std::unique_ptr<Checkpoint> new_checkpoint() const override;
  void save(Checkpoint& checkpoint) const override;
  void restore(const Checkpoint& checkpoint) override;

 private:
  struct FilterCheckpoint;
  Filter filter_;
  RandomWalkOptions walk_;
};

}  // namespace cairn
