#pragma once

#include "cairn/bayes/models.hpp"
#include "cairn/core/options.hpp"
#include "cairn/core/pose2.hpp"

namespace cairn {

/// How a robot strays of which nobody tells how it moves: standard deviations after one second; after t
/// seconds they are sqrt(t) times as large.
struct RandomWalkOptions {
  double sigma_m = 0.3;
  double sigma_rad = 0.3;

  void visit(OptionVisitor& visitor);
  double sigma_m_after(double seconds) const;
  double sigma_rad_after(double seconds) const;
};

/// Random walk of a pose for a time without odometry: the control is ignored.
class RandomWalk final : public MotionModel<Pose2, Pose2> {
 public:
  RandomWalk(const RandomWalkOptions& options, double seconds) : options_(options), seconds_(seconds) {}
  void propagate(const Pose2& ignored, std::span<Pose2> states, const RandomStream& random) const override;

 private:
  RandomWalkOptions options_;
  double seconds_;
};

}  // namespace cairn
