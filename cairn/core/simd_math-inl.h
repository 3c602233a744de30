// Elementary functions on all lanes, for the kernels of cairn/core/simd.hpp. Included once per path (hence no
// plain include guard) by files that have included <hwy/highway.h>.
//
// No fused multiply-add and no operation whose rounding depends on the lanes: every path gives the same bits.
// The polynomials are those of S. L. Moshier's Cephes library (coefficients are facts).
#if defined(CAIRN_CORE_SIMD_MATH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAIRN_CORE_SIMD_MATH_INL_H_
#undef CAIRN_CORE_SIMD_MATH_INL_H_
#else
#define CAIRN_CORE_SIMD_MATH_INL_H_
#endif

#include <cstdint>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace cairn::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct SineCosine {
  V sine;
  V cosine;
};

template <class D, class V>
HWY_INLINE V horner(D, V, V value) {
  return value;
}

// value * x + next, and so on through the coefficients.
template <class D, class V, class... More>
HWY_INLINE V horner(D d, V x, V value, double next, More... more) {
  return horner(d, x, hn::Add(hn::Mul(value, x), hn::Set(d, static_cast<hn::TFromD<D>>(next))), more...);
}

// The sine and cosine of `quadrant` right angles and an angle more, of which they are given.
template <class D, class DI, class V, class VI>
HWY_INLINE SineCosine<V> in_quadrant(D d, DI di, VI quadrant, V sine, V cosine) {
  constexpr int kSignBit = sizeof(hn::TFromD<D>) * 8 - 1;
  const auto one = hn::Set(di, 1);
  const auto swapped = hn::RebindMask(d, hn::Eq(hn::And(quadrant, one), one));
  const auto sine_sign = hn::ShiftLeft<kSignBit>(hn::ShiftRight<1>(quadrant));
  const auto cosine_sign = hn::ShiftLeft<kSignBit>(hn::ShiftRight<1>(hn::Add(quadrant, one)));
  return {hn::Xor(hn::IfThenElse(swapped, cosine, sine), hn::BitCast(d, sine_sign)),
          hn::Xor(hn::IfThenElse(swapped, sine, cosine), hn::BitCast(d, cosine_sign))};
}

// For |r| <= pi / 4 plus rounding; single precision.
template <class D, class V = hn::Vec<D>>
HWY_INLINE SineCosine<V> sine_cosine_core(D d, V r, float) {
  const V z = hn::Mul(r, r);
  const V sine_tail = horner(d, z, hn::Set(d, -1.9515295891e-4f), 8.3321608736e-3, -1.6666654611e-1);
  const V cosine_tail =
      horner(d, z, hn::Set(d, 2.443315711809948e-5f), -1.388731625493765e-3, 4.166664568298827e-2);
  const V sine = hn::Add(hn::Mul(hn::Mul(sine_tail, z), r), r);
  const V half = hn::Mul(z, hn::Set(d, 0.5f));
  return {sine, hn::Add(hn::Sub(hn::Mul(hn::Mul(cosine_tail, z), z), half), hn::Set(d, 1.0f))};
}

// The same in double precision.
template <class D, class V = hn::Vec<D>>
HWY_INLINE SineCosine<V> sine_cosine_core(D d, V r, double) {
  const V z = hn::Mul(r, r);
  const V sine_tail = horner(d, z, hn::Set(d, 1.58962301576546568060e-10), -2.50507477628578072866e-8,
                             2.75573136213857245213e-6, -1.98412698295895385996e-4, 8.33333333332211858878e-3,
                             -1.66666666666666307295e-1);
  const V cosine_tail = horner(d, z, hn::Set(d, -1.13585365213876817300e-11), 2.08757008419747316778e-9,
                               -2.75573141792967388112e-7, 2.48015872888517045348e-5,
                               -1.38888888888730564116e-3, 4.16666666666665929218e-2);
  const V sine = hn::Add(hn::Mul(hn::Mul(sine_tail, z), r), r);
  const V half = hn::Mul(z, hn::Set(d, 0.5));
  return {sine, hn::Add(hn::Sub(hn::Mul(hn::Mul(cosine_tail, z), z), half), hn::Set(d, 1.0))};
}

// The nearest whole number as an integer, and as what it was: |x| < 2^21 (float) or 2^50 (double). Adding
// 1.5 times the power of two from which on the format holds whole numbers only leaves them in the low bits.
template <class D>
HWY_INLINE constexpr hn::TFromD<D> rounding_bias(D) {
  return sizeof(hn::TFromD<D>) == 4 ? static_cast<hn::TFromD<D>>(12582912.0)
                                    : static_cast<hn::TFromD<D>>(6755399441055744.0);
}

// Sine and cosine of angles, |x| < 1e6 (double) or 1e3 (float): within 2 units of the last place of 1.
// Others, infinite ones too, give garbage, but no trap.
template <class D, class V = hn::Vec<D>>
HWY_INLINE SineCosine<V> sine_cosine(D d, V x) {
  const hn::RebindToSigned<D> di;
  using T = hn::TFromD<D>;
  constexpr bool kSingle = sizeof(T) == 4;
  // pi / 2 in three parts, the first two short enough for exact products (Cody & Waite).
  constexpr auto kPart1 = static_cast<T>(kSingle ? 1.5703125 : 1.57079625129699707031);
  constexpr auto kPart2 = static_cast<T>(kSingle ? 4.837512969970703125e-4 : 7.54978941586159635335e-8);
  constexpr auto kPart3 = static_cast<T>(kSingle ? 7.549789948768648e-8 : 5.39030285815811905290e-15);
  const V bias = hn::Set(d, rounding_bias(d));
  const V biased = hn::Add(hn::Mul(x, hn::Set(d, static_cast<T>(0.63661977236758134308))), bias);
  const V n = hn::Sub(biased, bias);
  V r = hn::Sub(x, hn::Mul(n, hn::Set(d, kPart1)));
  r = hn::Sub(r, hn::Mul(n, hn::Set(d, kPart2)));
  r = hn::Sub(r, hn::Mul(n, hn::Set(d, kPart3)));
  const auto [sine, cosine] = sine_cosine_core(d, r, T{});
  return in_quadrant(d, di, hn::BitCast(di, biased), sine, cosine);
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAIRN_CORE_SIMD_MATH_INL_H_
