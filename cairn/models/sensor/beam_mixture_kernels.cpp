#include "cairn/models/sensor/beam_mixture_kernels.hpp"

#include <cmath>
#include <numbers>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cairn/models/sensor/beam_mixture_kernels.cpp"
// Highway must come first.
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "cairn/core/simd_math-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace cairn::HWY_NAMESPACE {

using Floats = hn::ScalableTag<float>;
using F = hn::Vec<Floats>;

HWY_INLINE F all(float value) { return hn::Set(Floats(), value); }

constexpr float kSmallestExponent = -124.0f;  // 2 to the power of less counts as that of this, 5e-38
constexpr float kLeastExpected_m = 1e-3f;     // a ray that starts in a wall: keeps 1 - exp(-lambda r) above 0
constexpr float kBeyondReach_m = 1e9f;        // the map's range of a ray that meets nothing

// 2 to the power of numbers that are not positive, within 4e-6 of itself: the polynomial through its values
// at five Chebyshev nodes of [-1/2, 1/2].
HWY_INLINE F power_of_two(F x) {
  const Floats d;
  const hn::RebindToSigned<Floats> di;
  x = hn::Max(x, all(kSmallestExponent));
  const F bias = all(rounding_bias(d));
  const F biased = hn::Add(x, bias);
  const F power = horner(d, hn::Sub(x, hn::Sub(biased, bias)), all(9.666368515387469e-3f),
                         5.5921975842256264e-2, 0.24022349038020335, 0.693121045203427, 1.0);
  return hn::BitCast(d, hn::Add(hn::BitCast(di, power), hn::ShiftLeft<23>(hn::BitCast(di, biased))));
}

HWY_INLINE void multiply_vector(F probability, std::size_t i, BeamProducts& products) {
  const Floats d;
  const hn::RebindToSigned<Floats> di;
  const F factor = hn::Load(d, &products.factor[i]);
  const auto bits = hn::BitCast(di, hn::Mul(factor, hn::Max(probability, all(kLeastProbability))));
  const auto one = hn::BitCast(di, all(1.0f));
  const auto exponent = hn::Sub(hn::ShiftRight<23>(bits), hn::Set(di, 127));
  hn::Store(hn::Add(hn::Load(di, &products.exponent[i]), exponent), di, &products.exponent[i]);
  const auto mantissa = hn::Or(hn::And(bits, hn::Set(di, 0x7fffff)), one);
  hn::Store(hn::BitCast(d, mantissa), d, &products.factor[i]);
}

void multiply_return(const BeamCauses& causes, float z_m, float unexpected, const float* ranges_m,
                     BeamProducts& products) {
  const Floats d;
  const BeamCauses c = causes;  // not to be read again after each store
  constexpr float kBitsPerNat = std::numbers::log2e_v<float>;
  const F per_spread = all(c.per_sigma * std::sqrt(0.5f * kBitsPerNat)),
          lambda = all(c.lambda_per_m * kBitsPerNat);
  const F z = all(z_m), one = all(1.0f);
  for (std::size_t i = 0; i < BeamProducts::kCapacity; i += hn::Lanes(d)) {
    const F middle = hn::Add(hn::LoadU(d, ranges_m + i), all(c.depth_m));
    const F met = hn::IfThenElse(hn::Lt(middle, all(c.max_range_m)), middle, all(kBeyondReach_m));
    const F r = hn::Max(met, all(kLeastExpected_m));
    const F deviation = hn::Mul(hn::Sub(z, r), per_spread);
    const F hit = hn::Mul(all(c.hit), power_of_two(hn::Neg(hn::Mul(deviation, deviation))));
    const F before_wall = hn::Sub(one, power_of_two(hn::Neg(hn::Mul(r, lambda))));
    const F near = hn::IfThenElseZero(hn::Le(z, r), hn::Div(all(unexpected), before_wall));
    multiply_vector(hn::Add(hn::Add(hit, near), all(c.rand)), i, products);
  }
}

void multiply(const float* probabilities, BeamProducts& products) {
  const Floats d;
  for (std::size_t i = 0; i < BeamProducts::kCapacity; i += hn::Lanes(d))
    multiply_vector(hn::LoadU(d, probabilities + i), i, products);
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn {

HWY_EXPORT(multiply_return);
HWY_EXPORT(multiply);

double BeamProducts::log(std::size_t i) const {
  return exponent[i] * std::numbers::ln2 + std::log(static_cast<double>(factor[i]));
}

void multiply_return(const BeamCauses& causes, float z_m, float unexpected, const float* ranges_m,
                     BeamProducts& products) {
  HWY_DYNAMIC_DISPATCH(multiply_return)(causes, z_m, unexpected, ranges_m, products);
}

void multiply(const float* probabilities, BeamProducts& products) {
  HWY_DYNAMIC_DISPATCH(multiply)(probabilities, products);
}

}  // namespace cairn
#endif  // HWY_ONCE
