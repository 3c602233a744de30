#pragma once

#include "cairn/bayes/hypotheses.hpp"
#include "cairn/bayes/models.hpp"
#include "cairn/core/pose2.hpp"
#include "cairn/core/rng.hpp"
#include "cairn/core/time.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace cairn {

/// How the robot moved between two instants.
struct PoseControl {
  Pose2 T_before_after;    ///< as the odometry measured it
  double unknown_s = 0.0;  ///< seconds of it for which there is no odometry: the robot may have gone anywhere
};

/// A belief in a few numbers, about its heaviest hypothesis.
struct PoseSummary {
  Pose2 T_map_base;                                      ///< mean
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of (x, y, theta) in the map frame: m, rad
  double ess = 0.0;                                      ///< effective sample size
  int particles = 0;
  int hypotheses = 1;                       ///< separate groups of particles
  double weight = 1.0;                      ///< share of the belief in the heaviest one
  std::vector<PoseHypothesis> places = {};  ///< those groups, heaviest first; none: there is one, as above
};

/// A Bayes filter over the pose of a robot, of whatever kind: what the run-time around it knows of it.
/// Deterministic, and able to go back: the same controls and measurements after restore() give the same
/// bytes.
class PoseFilter {
 public:
  /// Draws one pose of the initial belief: item i of the random stream is the i-th.
  using Sampler = std::function<Pose2(const RandomStream&, std::uint32_t)>;

  /// The state of a filter of one kind, opaque. Its room is used again by save().
  class Checkpoint {
   public:
    virtual ~Checkpoint() = default;
  };

  virtual ~PoseFilter() = default;

  /// Begins anew with a belief that `sample` draws from.
  virtual void initialize(const Sampler& sample) = 0;
  virtual void predict(const PoseControl& control) = 0;
  virtual void correct(const BoundUpdate<Pose2>& z) = 0;

  /// False while the belief is spread over several places.
  virtual bool compact() const = 0;
  /// Number of states that a measurement is evaluated in.
  virtual std::size_t size() const = 0;
  virtual PoseSummary summarize() const = 0;
  /// A fair sample of at most `at_most` poses.
  virtual std::vector<Pose2> sample(std::size_t at_most) const = 0;

  virtual std::unique_ptr<Checkpoint> new_checkpoint() const = 0;
  /// @pre the checkpoint is from new_checkpoint() of this filter
  virtual void save(Checkpoint& checkpoint) const = 0;
  virtual void restore(const Checkpoint& checkpoint) = 0;
};

}  // namespace cairn
