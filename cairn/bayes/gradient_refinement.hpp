#pragma once

#include "cairn/bayes/refinement.hpp"
#include "cairn/core/options.hpp"
#include "cairn/core/pose2.hpp"

#include <vector>

namespace cairn {

struct GradientRefinementOptions {
  int steps = 3;              ///< r
  double eta_position = 0.8;  ///< share of the way to the maximum along the gradient, position
  double eta_heading = 0.6;   ///< likewise, heading
  double max_step_m = 0.1;
  double max_step_rad = 0.17453292519943295;  ///< 10 degrees
  double lever_m = 3.0;                       ///< a turn by 1 rad counts like a way of this length
  double kernel_width = 1.0;                  ///< of the density estimates, in units of the rule of thumb

  void visit(OptionVisitor& visitor);
};

/// Corrective gradient refinement of poses (Biswas, Coltin & Veloso, IROS 2011; Biswas & Veloso,
/// "Multi-Sensor Mobile Robot Localization for Diverse Environments", 2.1, steps 2 to 4):
///   q^0   the particles as predicted
///   q^r   each moved r times along the gradient of log p(z | x)
///   q     from each pair, the refined one is taken with probability min(1, p(z | x^r) / p(z | x^0)), else
///   the
///         predicted one: refinement may end on a wrong wall
///   w     times p(x | u) / q(x): densities by Gaussian kernels on the particles of q^0 and of q, so that
///         particles drawn together by refinement do not count for more than the motion allows
/// The filter then weighs with p(z | x) and resamples.
///
/// Step sizes: the published code moves by 0.4 times the mean offset of the matched points and turns by 0.2
/// times; where walls run in two directions, the mean is half of the way or less. A gradient alone has no
/// scale, so a second gradient, a centimetre further on, tells where along it the maximum lies; the step is
/// eta of that way. Position and heading are bounded
/// by max_step. Where the likelihood is not concave, the step has the bounded length.
class GradientRefinement final : public Refinement<Pose2> {
 public:
  explicit GradientRefinement(const GradientRefinementOptions& options) : options_(options) {}

  /// A measurement without gradient only weighs: nothing is moved.
  void refine(const BoundUpdate<Pose2>& z, ParticleSet<Pose2>& particles, const RandomStream& random,
              const Executor& executor) override;

 private:
  void ascend(const BoundUpdate<Pose2>& z, std::vector<Pose2>& states, const Executor& executor);
  void accept(const BoundUpdate<Pose2>& z, const std::vector<Pose2>& predicted, std::vector<Pose2>& states,
              const RandomStream& random, const Executor& executor);
  void weigh(const std::vector<Pose2>& predicted, ParticleSet<Pose2>& particles) const;

  GradientRefinementOptions options_;
  std::vector<Pose2> predicted_, refined_, probes_;
  std::vector<Eigen::Vector3d> gradients_, probe_gradients_;
  std::vector<double> before_, after_;
};

}  // namespace cairn
