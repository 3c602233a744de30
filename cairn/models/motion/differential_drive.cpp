#include "cairn/models/motion/differential_drive.hpp"

#include "cairn/core/angle.hpp"

#include <cmath>

namespace cairn {
namespace {

// Below this the direction of the translation is noise: it is kept as it is, and the whole rotation is taken
// as the second turn.
constexpr double kNoTranslation_m = 0.01;

struct TurnDriveTurn {
  double turn1;
  double drive;
  double turn2;
  double aside = 0.0;  ///< to the left while driving
};

TurnDriveTurn decompose(const Pose2& T) {
  const double drive = std::hypot(T.x, T.y);
  if (drive < kNoTranslation_m) return {0.0, T.x, T.theta, T.y};
  const double turn1 = std::atan2(T.y, T.x);
  if (std::abs(turn1) <= kPi / 2.0) return {turn1, drive, angle_difference(T.theta, turn1)};
  const double backwards = normalize_angle(turn1 + kPi);
  return {backwards, -drive, angle_difference(T.theta, backwards)};
}

double square(double x) { return x * x; }

}  // namespace

void DifferentialDriveOptions::visit(OptionVisitor& v) {
  const Range share{0.0, 100.0};
  v.number({"alpha1", "rotation noise caused by rotation (rad^2 per rad^2)", {"odom_alpha1"}}, alpha1, share);
  v.number({"alpha2", "rotation noise caused by translation (rad^2 per m^2)", {"odom_alpha2"}}, alpha2,
           share);
  v.number({"alpha3", "translation noise caused by translation (m^2 per m^2)", {"odom_alpha3"}}, alpha3,
           share);
  v.number({"alpha4", "translation noise caused by rotation (m^2 per rad^2)", {"odom_alpha4"}}, alpha4,
           share);
  v.number({"sigma_min_m", "noise of the position that every move adds, metres"}, sigma_min_m, {0.0, 10.0});
  v.number({"sigma_min_rad", "noise of the heading that every move adds, radians"}, sigma_min_rad,
           {0.0, 3.2});
}

void DifferentialDrive::propagate(const Pose2& T_before_after, std::span<Pose2> states,
                                  const RandomStream& random) const {
  const auto [turn1, drive, turn2, aside] = decompose(T_before_after);
  const auto& o = options_;
  const double sigma_turn1 = std::sqrt(o.alpha1 * square(turn1) + o.alpha2 * square(drive));
  const double sigma_turn2 =
      std::sqrt(o.alpha1 * square(turn2) + o.alpha2 * square(drive) + square(o.sigma_min_rad));
  const double sigma_drive = std::sqrt(o.alpha3 * square(drive) + o.alpha4 * (square(turn1) + square(turn2)) +
                                       square(o.sigma_min_m));
  for (std::size_t i = 0; i < states.size(); ++i) {
    const auto n = random.normal4(static_cast<std::uint32_t>(i));
    const double heading = states[i].theta + turn1 + sigma_turn1 * n[0];
    const double along = drive + sigma_drive * n[1];
    const double across = aside + o.sigma_min_m * n[3];
    const double c = std::cos(heading), s = std::sin(heading);
    states[i] = {states[i].x + c * along - s * across, states[i].y + s * along + c * across,
                 normalize_angle(heading + turn2 + sigma_turn2 * n[2])};
  }
}

}  // namespace cairn
