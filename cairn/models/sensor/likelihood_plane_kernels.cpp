#include "cairn/models/sensor/likelihood_plane_kernels.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cairn/models/sensor/likelihood_plane_kernels.cpp"
// Highway must come first.
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "cairn/core/simd_math-inl.h"
#include "cairn/maps/cell_places-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace cairn::HWY_NAMESPACE {

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

HWY_EXPORT(sum_codes);

void sum_codes(const LikelihoodPlaneView& plane, const BeamsView& beams, PoseBlock& poses) {
  HWY_DYNAMIC_DISPATCH(sum_codes)(plane, beams, poses);
}

}  // namespace cairn
#endif  // HWY_ONCE
