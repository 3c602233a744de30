#pragma once

#include "cairn/bayes/models.hpp"
#include "cairn/core/options.hpp"
#include "cairn/core/pose2.hpp"
#include "cairn/models/motion/noisy_move.hpp"

namespace cairn {

/// Noise of the odometry motion model. As in AMCL the alphas multiply squares, so that sqrt(alpha) is a
/// share.
struct DifferentialDriveOptions {
  double alpha1 = 0.2;         ///< rotation noise from rotation, rad^2 per rad^2
  double alpha2 = 0.3;         ///< rotation noise from translation, rad^2 per m^2
  double alpha3 = 0.05;        ///< translation noise from translation, m^2 per m^2
  double alpha4 = 0.2;         ///< translation noise from rotation, m^2 per rad^2
  double sigma_min_m = 0.0;    ///< standard deviation of the position that every move adds, metres
  double sigma_min_rad = 0.0;  ///< standard deviation of the heading that every move adds, radians

  void visit(OptionVisitor& visitor);
};

/// Odometry motion model of a wheeled robot: turn, drive, turn (Thrun et al., Probabilistic Robotics,
/// table 5.6).
///
/// The control is the motion since the last step in the robot's own frame, `T_before_after` as the odometry
/// measured it. Driving backwards counts as driving, not as two turns of 180 degrees. Noise across the
/// driving direction comes from the first turn and from `sigma_min_m`.
class DifferentialDrive final : public MotionModel<Pose2, Pose2> {
 public:
  explicit DifferentialDrive(const DifferentialDriveOptions& options) : options_(options) {}
  void propagate(const Pose2& T_before_after, std::span<Pose2> states,
                 const RandomStream& random) const override;

  /// What a control means for every particle: `propagate` applies it with the numbers of
  /// RandomStream::normal3 (turn 1, drive, turn 2), or of normal4, in single precision, where `sigma_min_m`
  /// asks for a fourth.
  NoisyMove noisy_move(const Pose2& T_before_after) const;

 private:
  DifferentialDriveOptions options_;
};

}  // namespace cairn
