#include "cairn/models/motion/differential_drive.hpp"

#include "cairn/core/angle.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

// Below this the direction of the translation is noise: it is kept as it is, and the whole rotation is taken
// as the second turn.
constexpr double kNoTranslation_m = 0.01;

NoisyMove decompose(const Pose2& T) {
  const double drive = std::hypot(T.x, T.y);
  if (drive < kNoTranslation_m) return {.drive = T.x, .turn2 = T.theta, .aside = T.y};
  const double turn1 = std::atan2(T.y, T.x);
  if (std::abs(turn1) <= kPi / 2.0) {
    return {.turn1 = turn1, .drive = drive, .turn2 = angle_difference(T.theta, turn1)};
  }
  const double backwards = normalize_angle(turn1 + kPi);
  return {.turn1 = backwards, .drive = -drive, .turn2 = angle_difference(T.theta, backwards)};
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

NoisyMove DifferentialDrive::noisy_move(const Pose2& T_before_after) const {
  NoisyMove move = decompose(T_before_after);
  const auto& o = options_;
  const double turn1 = square(move.turn1), drive = square(move.drive), turn2 = square(move.turn2);
  move.sigma_turn1 = std::sqrt(o.alpha1 * turn1 + o.alpha2 * drive);
  move.sigma_turn2 = std::sqrt(o.alpha1 * turn2 + o.alpha2 * drive + square(o.sigma_min_rad));
  move.sigma_drive = std::sqrt(o.alpha3 * drive + o.alpha4 * (turn1 + turn2) + square(o.sigma_min_m));
  move.sigma_aside = o.sigma_min_m;
  return move;
}

namespace {

template <class Noise>
void sample_in_batches(const NoisyMove& move, std::span<Pose2> states, const RandomStream& random) {
  Noise noise;
  for (std::size_t begin = 0; begin < states.size(); begin += Noise::kCapacity) {
    const std::size_t count = std::min(Noise::kCapacity, states.size() - begin);
    noise.fill(random, static_cast<std::uint32_t>(begin), count);
    apply(move, states.subspan(begin, count), noise);
  }
}

}  // namespace

void DifferentialDrive::propagate(const Pose2& T_before_after, std::span<Pose2> states,
                                  const RandomStream& random) const {
  const NoisyMove move = noisy_move(T_before_after);
  if (move == NoisyMove{}) return;  // headings would be rounded, up to 4e-9 rad at a time
  if (move.goes_aside()) {
    sample_in_batches<NormalBatch>(move, states, random);
  } else {
    sample_in_batches<Normal3Batch>(move, states, random);
  }
}

}  // namespace cairn
