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

#ifndef CAIRN_MODELS_MOTION_NOISY_MOVE_CONSTANTS_
#define CAIRN_MODELS_MOTION_NOISY_MOVE_CONSTANTS_
namespace cairn {
// Headings within this, in single precision, are in [-pi, pi).
inline constexpr float kSurelyWithin = 3.14159f;
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
HWY_INLINE void move_vector(const NoisyMove& m, double* states, const NormalBatch& noise, std::size_t i) {
  const Doubles d;
  const hn::Rebind<float, Doubles> df;
  const auto noisy = [&](double mean, double sigma, std::size_t k) {
    const D n = hn::PromoteTo(d, hn::LoadU(df, &noise.number[k][i]));
    return hn::Add(hn::Set(d, mean), hn::Mul(hn::Set(d, sigma), n));
  };
  D x, y, theta;
  hn::LoadInterleaved3(d, states, x, y, theta);
  const D heading = hn::Add(theta, noisy(m.turn1, m.sigma_turn1, 0));
  const D along = noisy(m.drive, m.sigma_drive, 1), across = noisy(m.aside, m.sigma_aside, 3);
  const auto [s, c] = sine_cosine(d, heading);
  const D new_x = hn::Sub(hn::Add(x, hn::Mul(c, along)), hn::Mul(s, across));
  const D new_y = hn::Add(hn::Add(y, hn::Mul(s, along)), hn::Mul(c, across));
  const D new_theta = normalized(hn::Add(heading, noisy(m.turn2, m.sigma_turn2, 2)));
  hn::StoreInterleaved3(new_x, new_y, new_theta, d, states);
}

void apply_all(const NoisyMove& move, double* states, std::size_t count, const NormalBatch& noise) {
  constexpr std::size_t kLanes = hn::MaxLanes(Doubles());
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) move_vector(move, states + 3 * i, noise, i);
  if (i == count) return;
  double rest[3 * kLanes] = {};
  std::copy_n(states + 3 * i, 3 * (count - i), rest);
  move_vector(move, rest, noise, i);
  std::copy_n(rest, 3 * (count - i), states + 3 * i);
}

using Floats = hn::ScalableTag<float>;
using F = hn::Vec<Floats>;

// Four poses at a time where the lanes allow it: twelve doubles.
using Quads = hn::CappedTag<double, 4>;
using QuadSingles = hn::Rebind<float, Quads>;
constexpr std::size_t kQuad = hn::MaxLanes(Quads());

void load_headings(const double* HWY_RESTRICT states, std::size_t count, float* HWY_RESTRICT theta) {
  const Quads d;
  const QuadSingles df;
  std::size_t i = 0;
  for (; i + kQuad <= count; i += kQuad) {
    hn::Vec<Quads> x, y, t;
    hn::LoadInterleaved3(d, states + 3 * i, x, y, t);
    hn::StoreU(hn::DemoteTo(df, t), df, theta + i);
  }
  for (; i < count; ++i) theta[i] = static_cast<float>(states[3 * i + 2]);
}

// Adds steps, which lie axis by axis, to poses, which lie one after the other.
HWY_INLINE void add_to_quad(const float* dx, const float* dy, const float* dtheta, double* states) {
  const Quads d;
  const QuadSingles df;
  const auto x = hn::PromoteTo(d, hn::LoadU(df, dx)), y = hn::PromoteTo(d, hn::LoadU(df, dy));
  const auto t = hn::PromoteTo(d, hn::LoadU(df, dtheta));
  const auto add = [&](hn::Vec<Quads> step, std::size_t k) {
    hn::StoreU(hn::Add(hn::LoadU(d, states + k * kQuad), step), d, states + k * kQuad);
  };
#if HWY_TARGET == HWY_SCALAR
  add(x, 0), add(y, 1), add(t, 2);
#else
  const auto xy = hn::InterleaveLower(d, x, y), tx = hn::OddEven(x, t), yt = hn::InterleaveUpper(d, y, t);
  if constexpr (kQuad == 2) {
    add(xy, 0), add(tx, 1), add(yt, 2);
  } else {
    add(hn::ConcatLowerLower(d, tx, xy), 0);
    add(hn::ConcatUpperLower(d, xy, yt), 1);
    add(hn::ConcatUpperUpper(d, yt, tx), 2);
  }
#endif
}

struct Steps {
  const float *x, *y, *theta;
};

void add_steps(const Steps& steps, double* HWY_RESTRICT states, std::size_t count) {
  std::size_t i = 0;
  for (; i + kQuad <= count; i += kQuad)
    add_to_quad(steps.x + i, steps.y + i, steps.theta + i, states + 3 * i);
  for (; i < count; ++i) {
    states[3 * i] += static_cast<double>(steps.x[i]);
    states[3 * i + 1] += static_cast<double>(steps.y[i]);
    states[3 * i + 2] += static_cast<double>(steps.theta[i]);
  }
}

// Sine and cosine within 1e-5, by those of half the angle; for less than 2^20 turns.
HWY_INLINE SineCosine<F> coarse_sine_cosine(F angle) {
  const Floats d;
  const F bias = hn::Set(d, rounding_bias(d));
  const F turns = hn::Mul(angle, hn::Set(d, static_cast<float>(1.0 / kTwoPi)));
  const F f = hn::Sub(turns, hn::Sub(hn::Add(turns, bias), bias));
  const F z = hn::Mul(f, f);
  const F s =
      hn::Mul(f, horner(d, z, hn::Set(d, -0.55948991144f), 2.5440208117, -5.1674076978, 3.1415902836));
  const F c =
      horner(d, z, hn::Set(d, 0.21969679847f), -1.3318801612, 4.0584119142, -4.9347928587, 0.99999995350);
  const F twice = hn::Add(s, s);
  return {hn::Mul(twice, c), hn::Sub(hn::Set(d, 1.0f), hn::Mul(twice, s))};
}

// Moves all states, unless a heading is or would come beyond kSurelyWithin: then none is moved and the answer
// is false, if `unless_far`.
bool sample_all(const NoisyMove& move, double* states, std::size_t count, const float* HWY_RESTRICT n_turn1,
                const float* HWY_RESTRICT n_drive, const float* HWY_RESTRICT n_turn2, bool unless_far) {
  constexpr std::size_t kPadded = Normal3Batch::kCapacity + 16;
  const Floats d;
  HWY_ALIGN float theta[kPadded], dx[kPadded], dy[kPadded], dtheta[kPadded];
  load_headings(states, count, theta);
  for (std::size_t i = count; i % hn::Lanes(d) != 0; ++i) theta[i] = 0.0f;
  const auto noisy = [&](double mean, double sigma, const float* n) {
    return hn::Add(hn::Set(d, static_cast<float>(mean)),
                   hn::Mul(hn::Set(d, static_cast<float>(sigma)), hn::LoadU(d, n)));
  };
  F farthest = hn::Zero(d);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const F before = hn::Load(d, theta + i);
    const F turn1 = noisy(move.turn1, move.sigma_turn1, n_turn1 + i);
    const F along = noisy(move.drive, move.sigma_drive, n_drive + i);
    const F turn = hn::Add(turn1, noisy(move.turn2, move.sigma_turn2, n_turn2 + i));
    const auto [s, c] = coarse_sine_cosine(hn::Add(before, turn1));
    hn::Store(hn::Mul(c, along), d, dx + i);
    hn::Store(hn::Mul(s, along), d, dy + i);
    hn::Store(turn, d, dtheta + i);
    farthest = hn::Max(farthest, hn::Max(hn::Abs(before), hn::Abs(hn::Add(before, turn))));
  }
  if (unless_far && !hn::AllTrue(d, hn::Lt(farthest, hn::Set(d, kSurelyWithin)))) return false;
  add_steps({dx, dy, dtheta}, states, count);
  return true;
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn {
namespace {

HWY_EXPORT(apply_all);
HWY_EXPORT(sample_all);

// Within, the fast sine and cosine are exact to the last digits.
constexpr double kLargestHeading = 1e5;
// Noise of a thousandth of the way is a hundred times the error of single precision.
constexpr double kLeastHiding = 1e-3;

void wrap_headings(std::span<Pose2> states) {
  for (Pose2& state : states) {
    if (!(state.theta >= -kPi && state.theta < kPi)) state.theta = normalize_angle(state.theta);
  }
}

}  // namespace

Pose2 NoisyMove::applied(const Pose2& state, double n_turn1, double n_drive, double n_turn2,
                         double n_aside) const {
  const double heading = state.theta + (turn1 + sigma_turn1 * n_turn1);
  const double along = drive + sigma_drive * n_drive, across = aside + sigma_aside * n_aside;
  const double c = std::cos(heading), s = std::sin(heading);
  return {state.x + c * along - s * across, state.y + s * along + c * across,
          normalize_angle(heading + (turn2 + sigma_turn2 * n_turn2))};
}

void apply(const NoisyMove& move, std::span<Pose2> states, const NormalBatch& noise) {
  CAIRN_ASSERT(states.size() <= NormalBatch::kCapacity);
  static_assert(sizeof(Pose2) == 3 * sizeof(double));
  for (Pose2& state : states) {
    if (!(std::abs(state.theta) < kLargestHeading)) state.theta = normalize_angle(state.theta);
  }
  HWY_DYNAMIC_DISPATCH(apply_all)(move, &states.data()->x, states.size(), noise);
}

bool NoisyMove::hides_single_precision() const {
  const auto hides = [](double sigma, double mean) { return sigma >= kLeastHiding * std::abs(mean); };
  return aside == 0.0 && sigma_aside == 0.0 && hides(sigma_turn1, turn1) && hides(sigma_drive, drive) &&
         hides(sigma_turn2, turn2);
}

void apply(const NoisyMove& move, std::span<Pose2> states, const Normal3Batch& noise) {
  CAIRN_ASSERT(states.size() <= Normal3Batch::kCapacity);
  const auto sample = [&](bool unless_far) {
    return HWY_DYNAMIC_DISPATCH(sample_all)(move, &states.data()->x, states.size(), noise.number(0),
                                            noise.number(1), noise.number(2), unless_far);
  };
  if (sample(true)) return;
  wrap_headings(states);
  sample(false);
  wrap_headings(states);
}

}  // namespace cairn
#endif  // HWY_ONCE
