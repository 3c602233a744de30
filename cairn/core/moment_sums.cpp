#include "cairn/core/moment_sums.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cairn/core/moment_sums.cpp"
// Highway must come first.
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "cairn/core/simd_math-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace cairn::HWY_NAMESPACE {

using Doubles = hn::ScalableTag<double>;
using D = hn::Vec<Doubles>;

constexpr std::size_t kSums = 8;  // partial ones, whatever the lanes
constexpr std::size_t kLanes = hn::MaxLanes(Doubles());
constexpr std::size_t kVectors = kSums / kLanes;

// A sum of kSums parts.
struct Sum {
  D parts[kVectors];

  HWY_INLINE Sum() {
    for (D& part : parts) part = hn::Zero(Doubles());
  }
  HWY_INLINE void add(std::size_t v, D value) { parts[v] = hn::Add(parts[v], value); }
  HWY_INLINE double total() const {
    double all[kSums], sum = 0.0;
    for (std::size_t v = 0; v < kVectors; ++v) hn::StoreU(parts[v], Doubles(), all + v * kLanes);
    for (const double part : all) sum += part;
    return sum;
  }
};

// Calls `visit(v, x, y, theta, weight)` with one vector of poses after the other, kSums poses at a time; the
// last ones are filled up with `filler` of weight 0.
template <class Visit>
HWY_INLINE void for_each_vector(std::span<const Pose2> poses, std::span<const double> weights,
                                const Pose2& filler, const Visit& visit) {
  const Doubles d;
  const auto eight = [&](const Pose2* states, const double* w) HWY_ATTR {
    HWY_UNROLL(8)
    for (std::size_t v = 0; v < kVectors; ++v) {
      D x, y, theta;
      hn::LoadInterleaved3(d, &states[v * kLanes].x, x, y, theta);
      visit(v, x, y, theta, hn::LoadU(d, w + v * kLanes));
    }
  };
  std::size_t i = 0;
  for (; i + kSums <= poses.size(); i += kSums) eight(&poses[i], &weights[i]);
  if (i == poses.size()) return;
  Pose2 states[kSums];
  double w[kSums] = {};
  std::fill_n(states, kSums, filler);
  std::copy(poses.begin() + static_cast<std::ptrdiff_t>(i), poses.end(), states);
  std::copy(weights.begin() + static_cast<std::ptrdiff_t>(i), weights.end(), w);
  eight(states, w);
}

FirstSums first_sums_kernel(std::span<const Pose2> poses, std::span<const double> weights) {
  const Doubles d;
  Sum weight, sum_x, sum_y, sum_c, sum_s;
  D largest = hn::Zero(d);
  for_each_vector(poses, weights, Pose2{}, [&](std::size_t v, D x, D y, D theta, D w) HWY_ATTR {
    const auto [s, c] = sine_cosine(d, theta);
    weight.add(v, w);
    sum_x.add(v, hn::Mul(w, x));
    sum_y.add(v, hn::Mul(w, y));
    sum_c.add(v, hn::Mul(w, c));
    sum_s.add(v, hn::Mul(w, s));
    largest = hn::Max(largest, hn::Abs(theta));
  });
  return {weight.total(), sum_x.total(), sum_y.total(),
          sum_c.total(),  sum_s.total(), hn::GetLane(hn::MaxOfLanes(d, largest))};
}

SecondSums second_sums_kernel(const Pose2& mean, std::span<const Pose2> poses,
                              std::span<const double> weights) {
  const Doubles d;
  const D bias = hn::Set(d, rounding_bias(d));
  Sum xx, xy, xt, yy, yt, tt;
  for_each_vector(poses, weights, mean, [&](std::size_t v, D x, D y, D theta, D w) HWY_ATTR {
    const D dx = hn::Sub(x, hn::Set(d, mean.x)), dy = hn::Sub(y, hn::Set(d, mean.y));
    const D turn = hn::Sub(theta, hn::Set(d, mean.theta));
    const D turns = hn::Sub(hn::Add(hn::Mul(turn, hn::Set(d, 1.0 / kTwoPi)), bias), bias);
    const D dt = hn::Sub(turn, hn::Mul(turns, hn::Set(d, kTwoPi)));
    const D wx = hn::Mul(w, dx), wy = hn::Mul(w, dy);
    xx.add(v, hn::Mul(wx, dx));
    xy.add(v, hn::Mul(wx, dy));
    xt.add(v, hn::Mul(wx, dt));
    yy.add(v, hn::Mul(wy, dy));
    yt.add(v, hn::Mul(wy, dt));
    tt.add(v, hn::Mul(hn::Mul(w, dt), dt));
  });
  return {xx.total(), xy.total(), xt.total(), yy.total(), yt.total(), tt.total()};
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn {

HWY_EXPORT(first_sums_kernel);
HWY_EXPORT(second_sums_kernel);

FirstSums first_sums(std::span<const Pose2> poses, std::span<const double> weights) {
  CAIRN_ASSERT(poses.size() == weights.size());
  return HWY_DYNAMIC_DISPATCH(first_sums_kernel)(poses, weights);
}

SecondSums second_sums(const Pose2& mean, std::span<const Pose2> poses, std::span<const double> weights) {
  CAIRN_ASSERT(poses.size() == weights.size());
  return HWY_DYNAMIC_DISPATCH(second_sums_kernel)(mean, poses, weights);
}

}  // namespace cairn
#endif  // HWY_ONCE
