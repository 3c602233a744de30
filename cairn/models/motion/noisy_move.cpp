#include "cairn/models/motion/noisy_move.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cairn/models/motion/noisy_move.cpp"
// Highway must come first.
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "cairn/core/simd_math-inl.h"
// clang-format on

#ifndef CAIRN_MODELS_MOTION_MOVE_NOISE_
#define CAIRN_MODELS_MOTION_MOVE_NOISE_
namespace cairn {
namespace {
// Normal numbers of a batch; some more behind the last may be read. Null: nothing goes aside.
struct MoveNoise {
  const float *turn1, *drive, *turn2, *aside;
};
}  // namespace
}  // namespace cairn
#endif

HWY_BEFORE_NAMESPACE();
namespace cairn::HWY_NAMESPACE {

using Doubles = hn::ScalableTag<double>;
using D = hn::Vec<Doubles>;

// normalize_angle for angles of less than 2^50 turns.
HWY_INLINE D normalized(D angle) {
  const Doubles d;
  const D bias = hn::Set(d, rounding_bias(d));
  const D turns = hn::Sub(hn::Add(hn::Mul(angle, hn::Set(d, 1.0 / kTwoPi)), bias), bias);
  const D wrapped = hn::Sub(angle, hn::Mul(turns, hn::Set(d, kTwoPi)));
  const D low = hn::Set(d, -kPi);
  return hn::IfThenElse(hn::Lt(wrapped, hn::Set(d, kPi)), hn::Max(wrapped, low), low);
}

// A vector of states, their doubles one after the other.
template <bool Aside>
HWY_INLINE void move_vector(const NoisyMove& m, double* states, const MoveNoise& noise, std::size_t i) {
  const Doubles d;
  const hn::Rebind<float, Doubles> df;
  const auto noisy = [&](double mean, double sigma, const float* numbers) {
    const D n = hn::PromoteTo(d, hn::LoadU(df, numbers + i));
    return hn::Add(hn::Set(d, mean), hn::Mul(hn::Set(d, sigma), n));
  };
  D x, y, theta;
  hn::LoadInterleaved3(d, states, x, y, theta);
  const D heading = hn::Add(theta, noisy(m.turn1, m.sigma_turn1, noise.turn1));
  const D along = noisy(m.drive, m.sigma_drive, noise.drive);
  const auto [s, c] = sine_cosine(d, heading);
  D new_x = hn::Add(x, hn::Mul(c, along)), new_y = hn::Add(y, hn::Mul(s, along));
  if constexpr (Aside) {
    const D across = noisy(m.aside, m.sigma_aside, noise.aside);
    new_x = hn::Sub(new_x, hn::Mul(s, across));
    new_y = hn::Add(new_y, hn::Mul(c, across));
  }
  const D new_theta = normalized(hn::Add(heading, noisy(m.turn2, m.sigma_turn2, noise.turn2)));
  hn::StoreInterleaved3(new_x, new_y, new_theta, d, states);
}

template <bool Aside>
HWY_INLINE void move_all(const NoisyMove& move, double* states, std::size_t count, const MoveNoise& noise) {
  constexpr std::size_t kLanes = hn::MaxLanes(Doubles());
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) move_vector<Aside>(move, states + 3 * i, noise, i);
  if (i == count) return;
  double rest[3 * kLanes] = {};
  std::copy_n(states + 3 * i, 3 * (count - i), rest);
  move_vector<Aside>(move, rest, noise, i);
  std::copy_n(rest, 3 * (count - i), states + 3 * i);
}

void apply_all(const NoisyMove& move, double* states, std::size_t count, const MoveNoise& noise) {
  if (noise.aside != nullptr) {
    move_all<true>(move, states, count, noise);
  } else {
    move_all<false>(move, states, count, noise);
  }
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn {
namespace {

HWY_EXPORT(apply_all);

// Within, the fast sine and cosine are exact to the last digits.
constexpr double kLargestHeading = 1e5;

}  // namespace

Pose2 NoisyMove::applied(const Pose2& state, double n_turn1, double n_drive, double n_turn2,
                         double n_aside) const {
  const double heading = state.theta + (turn1 + sigma_turn1 * n_turn1);
  const double along = drive + sigma_drive * n_drive, across = aside + sigma_aside * n_aside;
  const double c = std::cos(heading), s = std::sin(heading);
  return {state.x + c * along - s * across, state.y + s * along + c * across,
          normalize_angle(heading + (turn2 + sigma_turn2 * n_turn2))};
}

namespace {

void apply(const NoisyMove& move, std::span<Pose2> states, const MoveNoise& noise) {
  static_assert(sizeof(Pose2) == 3 * sizeof(double));
  for (Pose2& state : states) {
    if (!(std::abs(state.theta) < kLargestHeading)) state.theta = normalize_angle(state.theta);
  }
  HWY_DYNAMIC_DISPATCH(apply_all)(move, &states.data()->x, states.size(), noise);
}

}  // namespace

void apply(const NoisyMove& move, std::span<Pose2> states, const NormalBatch& noise) {
  CAIRN_ASSERT(states.size() <= NormalBatch::kCapacity);
  const auto& n = noise.number;
  apply(move, states, MoveNoise{n[0].data(), n[1].data(), n[2].data(), n[3].data()});
}

void apply(const NoisyMove& move, std::span<Pose2> states, const Normal3Batch& noise) {
  CAIRN_ASSERT(states.size() <= Normal3Batch::kCapacity && !move.goes_aside());
  apply(move, states, MoveNoise{noise.number(0), noise.number(1), noise.number(2), nullptr});
}

}  // namespace cairn
#endif  // HWY_ONCE
