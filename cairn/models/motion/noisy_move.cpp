#include "cairn/models/motion/noisy_move.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cairn/models/motion/noisy_move.cpp"
// Highway must come first.
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "cairn/core/simd_math-inl.h"
// clang-format on

#ifndef CAIRN_MODELS_MOTION_HEADINGS_
#define CAIRN_MODELS_MOTION_HEADINGS_
namespace cairn {
namespace {

// Cosine and sine of all whole multiples of 1 / kPerRadian from -8 to 8 rad, one pair after the other: first
// those from 0 on, then the negative ones, as the low bits of a number count.
constexpr int kPerRadian = 64;
constexpr std::size_t kHeadings = std::size_t{16} * kPerRadian;
using HeadingTable = std::array<double, 2 * kHeadings>;
constexpr double kLargestInTable = 8.0 - 1.0 / kPerRadian;

constexpr std::size_t kMostStates = NormalBatch::kCapacity;
static_assert(Normal3Batch::kCapacity <= kMostStates);

// Headings below are exact to the last digits.
constexpr double kLargestHeading = 1e5;

// Normal numbers of a batch in units of kUnit; some more behind the last may be read.
struct FourNumbers {
  static constexpr double kUnit = 1.0;
  static constexpr bool kAside = true;
  const float *turn1, *drive, *turn2, *aside;
  FourNumbers from(std::size_t i) const { return {turn1 + i, drive + i, turn2 + i, aside + i}; }
};
struct ThreeNumbers {
  static constexpr double kUnit = Normal3::kUnit;
  static constexpr bool kAside = false;
  const std::int16_t *turn1, *drive, *turn2;
  ThreeNumbers from(std::size_t i) const { return {turn1 + i, drive + i, turn2 + i}; }
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

// For the rare heading that is too large or not a number.
HWY_NOINLINE D normalized_exactly(D angles) {
  const Doubles d;
  HWY_ALIGN double each[hn::MaxLanes(Doubles())];
  hn::Store(angles, d, each);
  for (double& angle : each) {
    if (!(std::abs(angle) < kLargestHeading)) angle = normalize_angle(angle);
  }
  return hn::Load(d, each);
}

// A vector of normal numbers, in their unit.
HWY_INLINE D numbers_at(const float* numbers) {
  const Doubles d;
  return hn::PromoteTo(d, hn::LoadU(hn::Rebind<float, Doubles>(), numbers));
}
HWY_INLINE D numbers_at(const std::int16_t* numbers) {
  const Doubles d;
  const hn::Rebind<std::int32_t, Doubles> d32;
  return hn::PromoteTo(d, hn::PromoteTo(d32, hn::LoadU(hn::Rebind<std::int16_t, Doubles>(), numbers)));
}

// A part of the move, for normal numbers in units of `unit`.
struct NoisyPart {
  D mean, deviation;

  HWY_INLINE NoisyPart(double center, double sigma, double unit)
      : mean(hn::Set(Doubles(), center)), deviation(hn::Set(Doubles(), sigma * unit)) {}
  template <class Number>
  HWY_INLINE D at(const Number* numbers) const {
    return hn::Add(mean, hn::Mul(deviation, numbers_at(numbers)));
  }
};

struct Direction {
  D cosine, sine;
};

// The low bits of a number count the multiples.
HWY_INLINE const double* pair_at(const double* table, std::int64_t number) {
  return table + 2 * (static_cast<std::size_t>(number) % kHeadings);
}

#if HWY_TARGET == HWY_SCALAR
HWY_INLINE Direction looked_up(const double* table, const std::int64_t* place) {
  const Doubles d;
  const double* const pair = pair_at(table, *place);
  return {hn::Set(d, pair[0]), hn::Set(d, pair[1])};
}
#else
// The pairs at every other place, from this one on.
template <std::size_t Lanes>
HWY_INLINE auto pairs(const double* table, const std::int64_t* place) {
  const hn::CappedTag<double, Lanes> d;
  if constexpr (Lanes == 2) {
    return hn::Load(d, pair_at(table, *place));
  } else {
    return hn::Combine(d, pairs<Lanes / 2>(table, place + Lanes / 2), pairs<Lanes / 2>(table, place));
  }
}

HWY_INLINE Direction looked_up(const double* table, const std::int64_t* place) {
  const Doubles d;
  const D even = pairs<hn::MaxLanes(d)>(table, place), odd = pairs<hn::MaxLanes(d)>(table, place + 1);
  return {hn::InterleaveLower(d, even, odd), hn::InterleaveUpper(d, even, odd)};
}
#endif

// Steps of a length towards a heading: first towards the closest one of the table, then turned by what is
// left, at most 1 / 128: the polynomials of Taylor, the last one of the cosine moved a little towards what it
// leaves out, are right to 1e-16.
struct Towards {
  Direction table;
  D rest, cosine, sine_ratio;

  HWY_INLINE Towards(const Direction& closest, D left) : table(closest), rest(left) {
    const Doubles d;
    constexpr double kMostSquared = 0.25 / (kPerRadian * kPerRadian);
    const D z = hn::Mul(rest, rest);
    cosine = horner(d, z, hn::Set(d, 1.0 / 24.0 - 0.896 * kMostSquared / 720.0), -0.5, 1.0);
    sine_ratio = horner(d, z, hn::Set(d, 1.0 / 120.0), -1.0 / 6.0, 1.0);
  }

  HWY_INLINE Direction step(D length) const {
    const D ahead = hn::Mul(length, cosine), aside = hn::Mul(hn::Mul(length, rest), sine_ratio);
    return {hn::Sub(hn::Mul(table.cosine, ahead), hn::Mul(table.sine, aside)),
            hn::Add(hn::Mul(table.sine, ahead), hn::Mul(table.cosine, aside))};
  }
};

// Headings that the table does not have, or that are not numbers: rare. Others keep all their bits.
HWY_NOINLINE D turned_carefully(D theta, D turn1) {
  const Doubles d;
  const auto small = hn::Lt(hn::Abs(theta), hn::Set(d, kLargestHeading));
  if (!hn::AllTrue(d, small)) theta = normalized_exactly(theta);
  const D heading = hn::Add(theta, turn1);
  const auto beyond = hn::Gt(hn::Abs(heading), hn::Set(d, kLargestInTable));
  return hn::IfThenElse(beyond, normalized(heading), heading);
}

// At most kLargestInTable.
HWY_INLINE D turned(D theta, D turn1) {
  const Doubles d;
  const D heading = hn::Add(theta, turn1);
  const auto in_table = hn::Le(hn::Abs(heading), hn::Set(d, kLargestInTable));
  return HWY_LIKELY(hn::AllTrue(d, in_table)) ? heading : turned_carefully(theta, turn1);
}

// What the first pass finds of the states of a batch: their headings after the second turn; the place in the
// table of what is closest to those after the first turn, and the rest.
struct Headings {
  HWY_ALIGN double second[kMostStates];
  HWY_ALIGN double rest[kMostStates];
  HWY_ALIGN std::int64_t place[kMostStates];
};

template <class Noise>
HWY_INLINE void turn(const NoisyMove& move, const double* states, std::size_t count, const Noise& noise,
                     Headings& out) {
  const Doubles d;
  const hn::RebindToSigned<Doubles> di;
  const NoisyPart turn1(move.turn1, move.sigma_turn1, Noise::kUnit);
  const NoisyPart turn2(move.turn2, move.sigma_turn2, Noise::kUnit);
  // Adding 1.5 times the power of two from which on doubles are whole multiples of 1 / kPerRadian.
  const D bias = hn::Set(d, rounding_bias(d) / kPerRadian);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    D x, y, theta;
    hn::LoadInterleaved3(d, states + 3 * i, x, y, theta);
    const D heading = turned(theta, turn1.at(noise.turn1 + i));
    const D number = hn::Add(heading, bias);
    hn::Store(normalized(hn::Add(heading, turn2.at(noise.turn2 + i))), d, out.second + i);
    hn::Store(hn::Sub(heading, hn::Sub(number, bias)), d, out.rest + i);
    hn::Store(hn::BitCast(di, number), di, out.place + i);
  }
}

template <class Noise>
HWY_INLINE void drive(const NoisyMove& move, double* states, std::size_t count, const Noise& noise,
                      const Headings& from, const double* table) {
  const Doubles d;
  const NoisyPart ahead(move.drive, move.sigma_drive, Noise::kUnit);
  const NoisyPart aside(move.aside, move.sigma_aside, Noise::kUnit);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const Towards towards(looked_up(table, from.place + i), hn::Load(d, from.rest + i));
    D x, y, theta;
    hn::LoadInterleaved3(d, states + 3 * i, x, y, theta);
    const auto [dx, dy] = towards.step(ahead.at(noise.drive + i));
    x = hn::Add(x, dx), y = hn::Add(y, dy);
    if constexpr (Noise::kAside) {
      const auto [ax, ay] = towards.step(aside.at(noise.aside + i));
      x = hn::Sub(x, ay), y = hn::Add(y, ax);
    }
    hn::StoreInterleaved3(x, y, hn::Load(d, from.second + i), d, states + 3 * i);
  }
}

// A whole number of vectors.
template <class Noise>
HWY_INLINE void move_vectors(const NoisyMove& move, double* states, std::size_t count, const Noise& noise,
                             const double* table) {
  Headings headings;
  turn(move, states, count, noise, headings);
  drive(move, states, count, noise, headings, table);
}

template <class Noise>
HWY_INLINE void move_all(const NoisyMove& move, double* states, std::size_t count, const Noise& noise,
                         const double* table) {
  constexpr std::size_t kLanes = hn::MaxLanes(Doubles());
  const std::size_t left = count % kLanes, whole = count - left;
  move_vectors(move, states, whole, noise, table);
  if (left == 0) return;
  double last[3 * kLanes] = {};
  std::copy_n(states + 3 * whole, 3 * left, last);
  move_vectors(move, last, kLanes, noise.from(whole), table);
  std::copy_n(last, 3 * left, states + 3 * whole);
}

void apply_four(const NoisyMove& move, double* states, std::size_t count, const FourNumbers& noise,
                const double* table) {
  move_all(move, states, count, noise, table);
}

void apply_three(const NoisyMove& move, double* states, std::size_t count, const ThreeNumbers& noise,
                 const double* table) {
  move_all(move, states, count, noise, table);
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn {
namespace {

HWY_EXPORT(apply_four);
HWY_EXPORT(apply_three);

const double* heading_table() {
  alignas(64) static const HeadingTable table = [] {
    HeadingTable made;
    for (std::size_t k = 0; k < kHeadings; ++k) {
      const double number = static_cast<double>(k) - (k < kHeadings / 2 ? 0.0 : kHeadings);
      const double heading = number / kPerRadian;
      made[2 * k] = std::cos(heading), made[2 * k + 1] = std::sin(heading);
    }
    return made;
  }();
  return table.data();
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

static_assert(sizeof(Pose2) == 3 * sizeof(double));

void apply(const NoisyMove& move, std::span<Pose2> states, const NormalBatch& noise) {
  CAIRN_ASSERT(states.size() <= NormalBatch::kCapacity);
  const auto& n = noise.number;
  const FourNumbers numbers{n[0].data(), n[1].data(), n[2].data(), n[3].data()};
  HWY_DYNAMIC_DISPATCH(apply_four)(move, &states.data()->x, states.size(), numbers, heading_table());
}

void apply(const NoisyMove& move, std::span<Pose2> states, const Normal3Batch& noise) {
  CAIRN_ASSERT(states.size() <= Normal3Batch::kCapacity && !move.goes_aside());
  const ThreeNumbers numbers{noise.number(0), noise.number(1), noise.number(2)};
  HWY_DYNAMIC_DISPATCH(apply_three)(move, &states.data()->x, states.size(), numbers, heading_table());
}

}  // namespace cairn
#endif  // HWY_ONCE
