#include "cairn/models/motion/noisy_move.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"

#include <algorithm>
#include <array>
#include <bit>
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

#ifndef CAIRN_MODELS_MOTION_NOISY_MOVE_PARTS_
#define CAIRN_MODELS_MOTION_NOISY_MOVE_PARTS_
namespace cairn {
namespace {

constexpr std::size_t kMostStates = Normal3Batch::kCapacity;
static_assert(NormalBatch::kCapacity <= kMostStates);

// Normal numbers of a batch in units of kUnit, at most kLargest of them; some more behind the last may be
// read.
struct FourNumbers {
  static constexpr double kUnit = 1.0, kLargest = 7.0;
  static constexpr bool kAside = true;
  const float *turn1, *drive, *turn2, *aside;
  FourNumbers from(std::size_t i) const { return {turn1 + i, drive + i, turn2 + i, aside + i}; }
};
struct ThreeNumbers {
  static constexpr double kUnit = Normal3::kUnit, kLargest = 0x1p15;
  static constexpr bool kAside = false;
  const std::int16_t *turn1, *drive, *turn2;
  ThreeNumbers from(std::size_t i) const { return {turn1 + i, drive + i, turn2 + i}; }
};

// Angles are counted in 2^-32 turns: 32 bits of an integer, which wrap as angles do. They are the low half of
// the double that turns plus this number give.
constexpr double kCounting = 0x1.8p20;
constexpr double kPerRadian = 0x1p32 / kTwoPi;
std::uint32_t counted(double radians) {
  return static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(radians / kTwoPi + kCounting));
}

// A turn with noise, as the lanes count it: a number times `scale` plus kRounding is a float that holds the
// rounded product in its low 22 bits; shifted left by `shift` it counts 2^-32 turns. `offset` is the mean,
// less what the other bits add.
struct NoisyTurn {
  static constexpr float kRounding = 0x1.8p23f;
  float scale;
  int shift;
  std::uint32_t offset;

  NoisyTurn(double mean, double sigma, double unit, double largest) {
    const double most = std::min(0x1p30, sigma * unit * largest * (kPerRadian * 0x1p-21));
    shift = std::bit_width(static_cast<std::uint32_t>(most));
    scale = static_cast<float>(sigma * unit * kPerRadian / (std::int64_t{1} << shift));
    offset = counted(mean) - (std::bit_cast<std::uint32_t>(kRounding) << shift);
  }
};

// Which coordinate (0 x, 1 y, 2 theta) is what lane of the vectors that states fill in memory, for vectors of
// up to eight.
constexpr std::array<std::int64_t, 24> kCoordinate = {0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2,
                                                      0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2};

// As many states as a vector has lanes fill three vectors, and each lane has a given coordinate in one of the
// three only, as 3 and the number of lanes have no common divisor. Picking it there yields the coordinate of
// all states without a shuffle, but in another order: here is which state each lane has then.
template <std::size_t Lanes, std::size_t Coordinate>
constexpr std::array<std::int32_t, Lanes> states_of_lanes() {
  std::array<std::int32_t, Lanes> states{};
  for (std::size_t k = Coordinate; k < 3 * Lanes; k += 3)
    states[k % Lanes] = static_cast<std::int32_t>(k / 3);
  return states;
}

}  // namespace
}  // namespace cairn
#endif

HWY_BEFORE_NAMESPACE();
namespace cairn::HWY_NAMESPACE {

using Doubles = hn::ScalableTag<double>;
using Floats = hn::ScalableTag<float>;
using Ints = hn::RebindToSigned<Floats>;
using D = hn::Vec<Doubles>;
using V = hn::Vec<Floats>;
using I = hn::Vec<Ints>;
constexpr std::size_t kDoubles = hn::MaxLanes(Doubles()), kFloats = hn::MaxLanes(Floats());

// Moves a vector between the order of the states and the order that a coordinate has in memory.
class Order {
 public:
  using Places = std::array<std::int32_t, kFloats>;
  HWY_INLINE explicit Order(const Places& places) : indices_(hn::SetTableIndices(Ints(), places.data())) {}
  HWY_INLINE I operator()(I v) const { return hn::TableLookupLanes(v, indices_); }
  HWY_INLINE V operator()(V v) const { return hn::BitCast(Floats(), (*this)(hn::BitCast(Ints(), v))); }

  template <std::size_t Coordinate>
  static constexpr Places to_memory() {
    constexpr auto kStates = states_of_lanes<kDoubles, Coordinate>();
    Places places{};
    for (std::size_t i = 0; i < kFloats; ++i)
      places[i] = static_cast<std::int32_t>(i / kDoubles * kDoubles) + kStates[i % kDoubles];
    return places;
  }
  static constexpr Places inverse(const Places& there) {
    Places back{};
    for (std::size_t i = 0; i < kFloats; ++i)
      back[static_cast<std::size_t>(there[i])] = static_cast<std::int32_t>(i);
    return back;
  }

 private:
  decltype(hn::SetTableIndices(Ints(), static_cast<const std::int32_t*>(nullptr))) indices_;
};

// Bit l: lane l of vector `vector` has the coordinate.
constexpr int lanes_of(std::size_t vector, std::size_t coordinate) {
  int bits = 0;
  for (std::size_t l = 0; l < kDoubles; ++l) bits |= ((vector * kDoubles + l) % 3 == coordinate) << l;
  return bits;
}

// `there` in the lanes of a vector that hold the coordinate. IfThenElse becomes a blend by a mask, for which
// two units of the processor are there in place of four: 3 % of the time of a move.
template <std::size_t Vector, std::size_t Coordinate>
HWY_INLINE D with_lanes(D there, D elsewhere) {
#if HWY_TARGET == HWY_AVX2
  return D{_mm256_blend_pd(elsewhere.raw, there.raw, lanes_of(Vector, Coordinate))};
#else
  const hn::RebindToSigned<Doubles> di;
  const auto here = hn::LoadU(di, kCoordinate.data() + Vector * kDoubles);
  const auto mask =
      hn::RebindMask(Doubles(), hn::Eq(here, hn::Set(di, static_cast<std::int64_t>(Coordinate))));
  return hn::IfThenElse(mask, there, elsewhere);
#endif
}

HWY_INLINE D headings_of(const double* states) {
  const Doubles d;
  const D first = hn::LoadU(d, states), second = hn::LoadU(d, states + kDoubles);
  return with_lanes<1, 2>(second, with_lanes<0, 2>(first, hn::LoadU(d, states + std::size_t{2} * kDoubles)));
}

// What is added to the positions of a batch, and its new headings, in the orders of memory.
struct Steps {
  HWY_ALIGN float x[kMostStates], y[kMostStates];
  HWY_ALIGN std::int32_t heading[kMostStates];
};

// Headings in 2^-32 turns, with `offset` added, of as many states as there are lanes of floats; in the order
// of memory.
class HeadingReader {
 public:
  HWY_INLINE explicit HeadingReader(std::uint32_t offset)
      : seen_(hn::Zero(Doubles())), bias_(hn::Set(Doubles(), kCounting + offset * 0x1p-32)) {}

  HWY_INLINE I operator()(const double* states) {
#if HWY_TARGET == HWY_SCALAR
    const auto word = std::bit_cast<std::uint64_t>(hn::GetLane(counted(headings_of(states))));
    return hn::Set(Ints(), static_cast<std::int32_t>(static_cast<std::uint32_t>(word)));
#else
    const hn::Repartition<std::int32_t, Doubles> di;
    const D low = counted(headings_of(states)), high = counted(headings_of(states + 3 * kDoubles));
    return hn::ConcatEven(di, hn::BitCast(di, high), hn::BitCast(di, low));
#endif
  }

  // Whether all were less than two turns: then no exponent had the bit of 2.0.
  HWY_INLINE bool all_good() const {
    const Doubles d;
    const D bit = hn::Set(d, 2.0);
    return hn::AllTrue(d, hn::Eq(hn::And(seen_, bit), hn::Zero(d)));
  }

 private:
  HWY_INLINE D counted(D radians) {
    const D turns = hn::Mul(radians, hn::Set(Doubles(), 1.0 / kTwoPi));
    seen_ = hn::Or(seen_, turns);
    return hn::Add(turns, bias_);
  }

  D seen_, bias_;
};

// A vector of normal numbers, in their unit.
HWY_INLINE V numbers_at(const float* numbers) { return hn::LoadU(Floats(), numbers); }
HWY_INLINE V numbers_at(const std::int16_t* numbers) {
  const hn::Rebind<std::int16_t, Floats> d16;
  return hn::ConvertTo(Floats(), hn::PromoteTo(Ints(), hn::LoadU(d16, numbers)));
}

// Without its offset.
template <class Number>
HWY_INLINE I turned(const NoisyTurn& turn, const Number* numbers) {
  const Floats d;
  const V product = hn::Mul(numbers_at(numbers), hn::Set(d, turn.scale));
  const V rounded = hn::Add(product, hn::Set(d, NoisyTurn::kRounding));
  return hn::ShiftLeftSame(hn::BitCast(Ints(), rounded), turn.shift);
}

struct NoisyLength {
  V mean, deviation;

  HWY_INLINE NoisyLength(double center, double sigma, double unit)
      : mean(hn::Set(Floats(), static_cast<float>(center))),
        deviation(hn::Set(Floats(), static_cast<float>(sigma * unit))) {}
  template <class Number>
  HWY_INLINE V at(const Number* numbers) const {
    return hn::Add(mean, hn::Mul(deviation, numbers_at(numbers)));
  }
};

// Steps towards a heading: within 3e-7 of their length. Headings of more than a right angle go backwards from
// the opposite one.
struct Towards {
  V sign, angle, cosine, sine_ratio;

  HWY_INLINE explicit Towards(I heading) {
    const Floats d;
    const I twice = hn::Add(heading, heading);  // the halves of a turn wrap
    sign = hn::And(hn::BitCast(d, hn::Xor(heading, twice)), hn::SignBit(d));
    angle = hn::Mul(hn::ConvertTo(d, twice), hn::Set(d, static_cast<float>(0.5 / kPerRadian)));
    const V z = hn::Mul(angle, angle);
    cosine = horner(d, z, hn::Set(d, 2.33138413664416e-5f), -0.0013861600570695023, 0.041664803462082796,
                    -0.4999996556859674, 1.0);
    sine_ratio = horner(d, z, hn::Set(d, 2.5950657096123163e-6f), -0.00019803926640700332,
                        0.00833297118090601, -0.166666546192234, 1.0);
  }

  struct Step {
    V x, y;
  };
  HWY_INLINE Step step(V length) const {
    const V there = hn::Xor(length, sign);
    return {hn::Mul(there, cosine), hn::Mul(hn::Mul(there, angle), sine_ratio)};
  }
};

// Whether all headings were less than two turns.
template <class Noise>
HWY_INLINE bool find_steps(const NoisyMove& move, const double* states, std::size_t count, const Noise& noise,
                           Steps& steps) {
  const NoisyTurn turn1(move.turn1, move.sigma_turn1, Noise::kUnit, Noise::kLargest);
  const NoisyTurn turn2(move.turn2, move.sigma_turn2, Noise::kUnit, Noise::kLargest);
  const NoisyLength ahead(move.drive, move.sigma_drive, Noise::kUnit);
  const NoisyLength aside(move.aside, move.sigma_aside, Noise::kUnit);
  HeadingReader heading_at(turn1.offset);
  const I offset = hn::Set(Ints(), static_cast<std::int32_t>(turn2.offset));
  constexpr auto kX = Order::to_memory<0>(), kY = Order::to_memory<1>(), kTheta = Order::to_memory<2>();
  const Order to_x(kX), to_y(kY), to_theta(kTheta), from_theta(Order::inverse(kTheta));
  for (std::size_t i = 0; i < count; i += kFloats) {
    const I heading = hn::Add(from_theta(heading_at(states + 3 * i)), turned(turn1, noise.turn1 + i));
    const I second = hn::Add(hn::Add(heading, offset), turned(turn2, noise.turn2 + i));
    const Towards towards(heading);
    auto [x, y] = towards.step(ahead.at(noise.drive + i));
    if constexpr (Noise::kAside) {
      const auto [along, across] = towards.step(aside.at(noise.aside + i));
      x = hn::Sub(x, across), y = hn::Add(y, along);
    }
    hn::Store(to_x(x), Floats(), steps.x + i);
    hn::Store(to_y(y), Floats(), steps.y + i);
    hn::Store(to_theta(second), Ints(), steps.heading + i);
  }
  return heading_at.all_good();
}

template <std::size_t Vector>
HWY_INLINE void update(D dx, D dy, D heading, double* state) {
  const D moved = hn::Add(hn::LoadU(Doubles(), state), with_lanes<Vector, 1>(dy, dx));
  hn::StoreU(with_lanes<Vector, 2>(heading, moved), Doubles(), state);
}

HWY_INLINE void take_steps(const Steps& steps, double* states, std::size_t count) {
  const Doubles d;
  const hn::Rebind<float, Doubles> df;
  const hn::Rebind<std::int32_t, Doubles> di;
  for (std::size_t i = 0; i < count; i += kDoubles) {
    const D dx = hn::PromoteTo(d, hn::Load(df, steps.x + i)),
            dy = hn::PromoteTo(d, hn::Load(df, steps.y + i));
    const D heading =
        hn::Mul(hn::PromoteTo(d, hn::Load(di, steps.heading + i)), hn::Set(d, 1.0 / kPerRadian));
    double* const state = states + 3 * i;
    update<0>(dx, dy, heading, state);
    update<1>(dx, dy, heading, state + kDoubles);
    update<2>(dx, dy, heading, state + 2 * kDoubles);
  }
}

// Rare. A heading that is not a number makes the whole state so.
HWY_NOINLINE void wrap_headings(double* states, std::size_t count) {
  for (double* state = states; state != states + 3 * count; state += 3) {
    if (std::abs(state[2]) < 2.0 * kTwoPi) continue;
    state[2] = normalize_angle(state[2]);
    if (std::isnan(state[2])) state[0] = state[1] = state[2];
  }
}

// A whole number of vectors.
template <class Noise>
HWY_INLINE void move_vectors(const NoisyMove& move, double* states, std::size_t count, const Noise& noise) {
  Steps steps;
  if (HWY_UNLIKELY(!find_steps(move, states, count, noise, steps))) {
    wrap_headings(states, count);
    find_steps(move, states, count, noise, steps);
  }
  take_steps(steps, states, count);
}

template <class Noise>
HWY_INLINE void move_all(const NoisyMove& move, double* states, std::size_t count, const Noise& noise) {
  const std::size_t left = count % kFloats, whole = count - left;
  move_vectors(move, states, whole, noise);
  if (left == 0) return;
  double last[3 * kFloats] = {};
  std::copy_n(states + 3 * whole, 3 * left, last);
  move_vectors(move, last, kFloats, noise.from(whole));
  std::copy_n(last, 3 * left, states + 3 * whole);
}

void apply_four(const NoisyMove& move, double* states, std::size_t count, const FourNumbers& noise) {
  move_all(move, states, count, noise);
}

void apply_three(const NoisyMove& move, double* states, std::size_t count, const ThreeNumbers& noise) {
  move_all(move, states, count, noise);
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn {
namespace {

HWY_EXPORT(apply_four);
HWY_EXPORT(apply_three);

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
  HWY_DYNAMIC_DISPATCH(apply_four)(move, &states.data()->x, states.size(), numbers);
}

void apply(const NoisyMove& move, std::span<Pose2> states, const Normal3Batch& noise) {
  CAIRN_ASSERT(states.size() <= Normal3Batch::kCapacity && !move.goes_aside());
  const ThreeNumbers numbers{noise.number(0), noise.number(1), noise.number(2)};
  HWY_DYNAMIC_DISPATCH(apply_three)(move, &states.data()->x, states.size(), numbers);
}

}  // namespace cairn
#endif  // HWY_ONCE
