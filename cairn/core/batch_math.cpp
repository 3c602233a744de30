#include "cairn/core/batch_math.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cairn/core/batch_math.cpp"
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

constexpr double kSmallestExponent = -708.0;
constexpr double kLargestExponent = 709.0;

HWY_INLINE D exp_of(D x) {
  const Doubles d;
  const hn::RebindToSigned<Doubles> di;
  const D clamped = hn::Min(hn::Max(x, hn::Set(d, kSmallestExponent)), hn::Set(d, kLargestExponent));
  // x = n log 2 + r
  const D bias = hn::Set(d, rounding_bias(d));
  const D biased = hn::Add(hn::Mul(clamped, hn::Set(d, 1.4426950408889634073599)), bias);
  const D n = hn::Sub(biased, bias);
  D r = hn::Sub(clamped, hn::Mul(n, hn::Set(d, 6.93145751953125e-1)));
  r = hn::Sub(r, hn::Mul(n, hn::Set(d, 1.42860682030941723212e-6)));
  const D z = hn::Mul(r, r);
  const D p = hn::Mul(r, horner(d, z, hn::Set(d, 1.26177193074810590878e-4), 3.02994407707441961300e-2, 1.0));
  const D q = horner(d, z, hn::Set(d, 3.00198505138664455042e-6), 2.52448340349684104192e-3,
                     2.27265548208155028766e-1, 2.0);
  const D quotient = hn::Div(p, hn::Sub(q, p));
  const D power = hn::Add(hn::Add(quotient, quotient), hn::Set(d, 1.0));
  const D scaled =
      hn::BitCast(d, hn::Add(hn::BitCast(di, power), hn::ShiftLeft<52>(hn::BitCast(di, biased))));
  return hn::IfThenZeroElse(hn::Lt(x, hn::Set(d, kSmallestExponent)), scaled);
}

void exp_kernel(const double* values, double offset, double* out, std::size_t count) {
  const Doubles d;
  constexpr std::size_t kLanes = hn::MaxLanes(Doubles());
  const D shift = hn::Set(d, offset);
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes)
    hn::StoreU(exp_of(hn::Add(hn::LoadU(d, values + i), shift)), d, out + i);
  if (i == count) return;
  double rest[kLanes] = {};
  std::copy(values + i, values + count, rest);
  hn::StoreU(exp_of(hn::Add(hn::LoadU(d, rest), shift)), d, rest);
  std::copy_n(rest, count - i, out + i);
}

void sine_cosine_kernel(const double* angles, double* sine, double* cosine, std::size_t count) {
  const Doubles d;
  constexpr std::size_t kLanes = hn::MaxLanes(Doubles());
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    const auto [s, c] = sine_cosine(d, hn::LoadU(d, angles + i));
    hn::StoreU(s, d, sine + i);
    hn::StoreU(c, d, cosine + i);
  }
  if (i == count) return;
  double rest[kLanes] = {}, rest_cosine[kLanes];
  std::copy(angles + i, angles + count, rest);
  const auto [s, c] = sine_cosine(d, hn::LoadU(d, rest));
  hn::StoreU(s, d, rest);
  hn::StoreU(c, d, rest_cosine);
  std::copy_n(rest, count - i, sine + i);
  std::copy_n(rest_cosine, count - i, cosine + i);
}

double largest_kernel(const double* values, std::size_t count) {
  const Doubles d;
  constexpr std::size_t kLanes = hn::MaxLanes(Doubles()), kVectors = 4;
  double largest = values[0];
  D most[kVectors];
  for (D& m : most) m = hn::Set(d, largest);
  std::size_t i = 0;
  for (; i + kVectors * kLanes <= count; i += kVectors * kLanes) {
    HWY_UNROLL(4)
    for (std::size_t v = 0; v < kVectors; ++v)
      most[v] = hn::Max(most[v], hn::LoadU(d, values + i + v * kLanes));
  }
  const D of_all = hn::Max(hn::Max(most[0], most[1]), hn::Max(most[2], most[3]));
  largest = hn::GetLane(hn::MaxOfLanes(d, of_all));
  for (; i < count; ++i) largest = std::max(largest, values[i]);
  return largest;
}

// Eight partial sums, whatever the lanes.
double dot_kernel(const double* HWY_RESTRICT a, const double* HWY_RESTRICT b, std::size_t count) {
  constexpr std::size_t kSums = 8, kLanes = hn::MaxLanes(Doubles()), kVectors = kSums / kLanes;
  const Doubles d;
  D sums[kVectors];
  for (D& sum : sums) sum = hn::Zero(d);
  std::size_t i = 0;
  for (; i + kSums <= count; i += kSums) {
    HWY_UNROLL(8)
    for (std::size_t v = 0; v < kVectors; ++v) {
      const std::size_t at = i + v * kLanes;
      sums[v] = hn::Add(sums[v], hn::Mul(hn::LoadU(d, a + at), hn::LoadU(d, b + at)));
    }
  }
  double parts[kSums];
  for (std::size_t v = 0; v < kVectors; ++v) hn::StoreU(sums[v], d, parts + v * kLanes);
  for (std::size_t k = 0; i < count; ++i, ++k) parts[k] += a[i] * b[i];
  double sum = 0.0;
  for (const double part : parts) sum += part;
  return sum;
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn {
namespace {

HWY_EXPORT(exp_kernel);
HWY_EXPORT(sine_cosine_kernel);
HWY_EXPORT(largest_kernel);
HWY_EXPORT(dot_kernel);

}  // namespace

void exp_all(std::span<const double> values, double offset, std::span<double> out) {
  CAIRN_ASSERT(values.size() == out.size());
  HWY_DYNAMIC_DISPATCH(exp_kernel)(values.data(), offset, out.data(), values.size());
}

void sine_cosine_all(std::span<const double> angles, std::span<double> sine, std::span<double> cosine) {
  CAIRN_ASSERT(sine.size() == angles.size() && cosine.size() == angles.size());
  HWY_DYNAMIC_DISPATCH(sine_cosine_kernel)(angles.data(), sine.data(), cosine.data(), angles.size());
}

double largest_of(std::span<const double> values) {
  CAIRN_ASSERT(!values.empty());
  return HWY_DYNAMIC_DISPATCH(largest_kernel)(values.data(), values.size());
}

double sum_of(std::span<const double> values) {
  constexpr std::size_t kSums = 8;
  std::array<double, kSums> sums{};
  std::size_t i = 0;
  for (; i + kSums <= values.size(); i += kSums) {
    for (std::size_t k = 0; k < kSums; ++k) sums[k] += values[i + k];
  }
  for (std::size_t k = 0; i < values.size(); ++i, ++k) sums[k] += values[i];
  double sum = 0.0;
  for (const double s : sums) sum += s;
  return sum;
}

double sum_of_squares(std::span<const double> values) { return dot(values, values); }

double dot(std::span<const double> a, std::span<const double> b) {
  CAIRN_ASSERT(a.size() == b.size());
  return HWY_DYNAMIC_DISPATCH(dot_kernel)(a.data(), b.data(), a.size());
}

}  // namespace cairn
#endif  // HWY_ONCE
