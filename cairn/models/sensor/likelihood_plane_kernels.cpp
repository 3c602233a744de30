#include "cairn/models/sensor/likelihood_plane_kernels.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cairn/models/sensor/likelihood_plane_kernels.cpp"
// Highway must come first.
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "cairn/core/simd_math-inl.h"
#include "cairn/maps/cell_places-inl.h"
// clang-format on

#ifndef CAIRN_MODELS_SENSOR_LIKELIHOOD_PLANE_POSES_
#define CAIRN_MODELS_SENSOR_LIKELIHOOD_PLANE_POSES_
namespace cairn {
namespace {

// One pose, whatever it is.
void put_one(const PlaneFrame& f, const Pose2& state, std::size_t i, PoseBlock& block) {
  const double x = f.x + f.cosine * state.x - f.sine * state.y;
  const double y = f.y + f.sine * state.x + f.cosine * state.y;
  double heading = state.theta + f.theta;
  if (!(heading >= -kPi && heading < kPi)) heading = normalize_angle(heading);
  const bool near = std::abs(x) < kFarAway_cells && std::abs(y) < kFarAway_cells && !std::isnan(heading);
  block.x[i] = static_cast<float>(near ? x : 4.0 * kFarAway_cells);
  block.y[i] = static_cast<float>(near ? y : 4.0 * kFarAway_cells);
  block.heading[i] = static_cast<float>(near ? heading : 0.0);
}

}  // namespace
}  // namespace cairn
#endif

HWY_BEFORE_NAMESPACE();
namespace cairn::HWY_NAMESPACE {

using Doubles = hn::ScalableTag<double>;

// A vector of poses that are near and turned by less than pi; false, and nothing done, if one is not.
HWY_INLINE bool put_vector(const PlaneFrame& f, const double* states, std::size_t i, PoseBlock& block) {
  const Doubles d;
  const hn::Rebind<float, Doubles> d32;
  hn::Vec<Doubles> map_x, map_y, theta;
  hn::LoadInterleaved3(d, states, map_x, map_y, theta);
  const auto c = hn::Set(d, f.cosine), s = hn::Set(d, f.sine), far = hn::Set(d, kFarAway_cells);
  const auto x = hn::Sub(hn::Add(hn::Set(d, f.x), hn::Mul(c, map_x)), hn::Mul(s, map_y));
  const auto y = hn::Add(hn::Add(hn::Set(d, f.y), hn::Mul(s, map_x)), hn::Mul(c, map_y));
  const auto heading = hn::Add(theta, hn::Set(d, f.theta));
  const auto near = hn::And(hn::Lt(hn::Abs(x), far), hn::Lt(hn::Abs(y), far));
  if (!hn::AllTrue(d, hn::And(near, hn::Lt(hn::Abs(heading), hn::Set(d, kPi))))) return false;
  hn::StoreU(hn::DemoteTo(d32, x), d32, &block.x[i]);
  hn::StoreU(hn::DemoteTo(d32, y), d32, &block.y[i]);
  hn::StoreU(hn::DemoteTo(d32, heading), d32, &block.heading[i]);
  return true;
}

void put_in_cells(const PlaneFrame& frame, std::span<const Pose2> states, PoseBlock& block) {
  constexpr std::size_t kLanes = hn::MaxLanes(Doubles()), kFloats = hn::MaxLanes(Places::Floats());
  const PlaneFrame f = frame;
  std::size_t i = 0;
  for (; i + kLanes <= states.size(); i += kLanes) {
    if (HWY_LIKELY(put_vector(f, &states[i].x, i, block))) continue;
    for (std::size_t k = i; k < i + kLanes; ++k) put_one(f, states[k], k, block);
  }
  for (; i < states.size(); ++i) put_one(f, states[i], i, block);
  block.count = states.size();
  for (; i < PoseBlock::kCapacity && i % kFloats != 0; ++i) block.heading[i] = 0.0f;
}

constexpr std::size_t kBeamsAtOnce = 256;

struct Lanes {
  Places::F x, y, cosine, sine;
};

// Where the beams of one pose end: a vector of beams after the other.
HWY_INLINE void store_places(const Places& places, const Lanes& pose, const float* beams_x,
                             const float* beams_y, std::uint32_t* HWY_RESTRICT out) {
  const Places::Floats d;
  const auto x = hn::LoadU(d, beams_x), y = hn::LoadU(d, beams_y);
  const auto column = hn::Sub(hn::Add(pose.x, hn::Mul(pose.cosine, x)), hn::Mul(pose.sine, y));
  const auto row = hn::Add(hn::Add(pose.y, hn::Mul(pose.sine, x)), hn::Mul(pose.cosine, y));
  hn::Store(places.of(column, row), Places::Words(), out);
}

// Sums the codes at the places `from` while it works out the places `to` of the next pose: the arithmetic of
// one runs beside the memory accesses of the other. Half as long as one after the other.
template <class Code>
HWY_INLINE std::uint32_t sum_and_look_ahead(const Places& places, const Code* HWY_RESTRICT codes,
                                            const BeamsView& beams, const Lanes& next,
                                            const std::uint32_t* HWY_RESTRICT from,
                                            std::uint32_t* HWY_RESTRICT to) {
  constexpr std::size_t kLanes = hn::MaxLanes(Places::Floats());
  std::uint32_t even = 0, odd = 0;
  std::size_t k = 0;
  for (; k + kLanes <= beams.count; k += kLanes) {
    store_places(places, next, beams.x + k, beams.y + k, to + k);
    HWY_UNROLL(16)
    for (std::size_t j = 0; j < kLanes; ++j) (j % 2 == 0 ? even : odd) += codes[from[k + j]];
  }
  if (k < beams.count) store_places(places, next, beams.x + k, beams.y + k, to + k);
  for (; k < beams.count; ++k) even += codes[from[k]];
  return even + odd;
}

// Adds the codes of at most kBeamsAtOnce beams.
template <class Code>
void add_beams(const Places& places, const Code* codes, const BeamsView& beams, PoseBlock& poses) {
  const Places::Floats d;
  HWY_ALIGN std::uint32_t at[2][kBeamsAtOnce + hn::MaxLanes(d)] = {};  // at first any place will do
  const auto lanes_of = [&](std::size_t i) {
    return Lanes{hn::Set(d, poses.x[i]), hn::Set(d, poses.y[i]), hn::Set(d, poses.cosine[i]),
                 hn::Set(d, poses.sine[i])};
  };
  sum_and_look_ahead(places, codes, beams, lanes_of(0), at[1], at[0]);
  for (std::size_t i = 0; i < poses.count; ++i) {
    const Lanes next = lanes_of(i + 1 < poses.count ? i + 1 : i);
    poses.sums[i] += sum_and_look_ahead(places, codes, beams, next, at[i % 2], at[(i + 1) % 2]);
  }
}

template <class Code>
void add_all(const LikelihoodPlaneView& plane, const Code* codes, const BeamsView& beams, PoseBlock& poses) {
  const Places places(plane.columns, plane.rows);
  std::fill_n(poses.sums.begin(), poses.count, 0u);
  for (std::size_t begin = 0; begin < beams.count; begin += kBeamsAtOnce) {
    const std::size_t count = std::min(kBeamsAtOnce, beams.count - begin);
    add_beams(places, codes, {beams.x + begin, beams.y + begin, count}, poses);
  }
}

void sum_codes(const LikelihoodPlaneView& plane, const BeamsView& beams, PoseBlock& poses) {
  if (poses.count == 0) return;
  const Places::Floats d;
  for (std::size_t i = 0; i < poses.count; i += hn::Lanes(d)) {
    const auto [sine, cosine] = sine_cosine(d, hn::Load(d, poses.heading.data() + i));
    hn::Store(cosine, d, poses.cosine.data() + i);
    hn::Store(sine, d, poses.sine.data() + i);
  }
  if (plane.narrow != nullptr) {
    add_all(plane, plane.narrow, beams, poses);
  } else {
    add_all(plane, plane.wide, beams, poses);
  }
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn {

HWY_EXPORT(put_in_cells);
HWY_EXPORT(sum_codes);

void put_in_cells(const PlaneFrame& frame, std::span<const Pose2> states, PoseBlock& block) {
  CAIRN_ASSERT(states.size() <= PoseBlock::kCapacity);
  static_assert(sizeof(Pose2) == 3 * sizeof(double));
  HWY_DYNAMIC_DISPATCH(put_in_cells)(frame, states, block);
}

void sum_codes(const LikelihoodPlaneView& plane, const BeamsView& beams, PoseBlock& poses) {
  HWY_DYNAMIC_DISPATCH(sum_codes)(plane, beams, poses);
}

}  // namespace cairn
#endif  // HWY_ONCE
