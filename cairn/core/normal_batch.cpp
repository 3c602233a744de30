#include "cairn/core/normal_batch.hpp"

#include "cairn/core/errors.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cairn/core/normal_batch.cpp"
// Highway must come first.
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "cairn/core/philox-inl.h"
#include "cairn/core/simd_math-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace cairn::HWY_NAMESPACE {

using Floats = hn::ScalableTag<float>;
using Words = hn::RebindToUnsigned<Floats>;
using Integers = hn::RebindToSigned<Floats>;
using F = hn::Vec<Floats>;
using W = hn::Vec<Words>;

struct WordsOfItems {
  W w0, w1, w2, w3;
};

#if HWY_TARGET == HWY_SCALAR

// One item at a time.
struct Blocks {
  PhiloxCounter first;
  PhiloxKey key;

  WordsOfItems of_item(std::size_t item) const {
    const PhiloxCounter block = {first[0] + static_cast<std::uint32_t>(item), first[1], first[2], first[3]};
    const auto words = philox4x32_10(block, key);
    const Words d;
    return {hn::Set(d, words[0]), hn::Set(d, words[1]), hn::Set(d, words[2]), hn::Set(d, words[3])};
  }
};

#else

// One item per lane.
struct Blocks {
  PhiloxBlocks<10> blocks;

  HWY_INLINE Blocks(const PhiloxCounter& first, const PhiloxKey& key) : blocks(first, key) {}

  HWY_INLINE WordsOfItems of_item(std::size_t item) const {
    const Words d32;
    PhiloxState low = blocks.three_rounds(item), high = blocks.three_rounds(item + hn::Lanes(PhiloxLongs()));
    blocks.middle_rounds(low, high);
    const auto l = blocks.last_round(low), h = blocks.last_round(high);
    const auto even = [&](auto a, auto b) {
      return hn::ConcatEven(d32, hn::BitCast(d32, b), hn::BitCast(d32, a));
    };
    const auto odd = [&](auto a, auto b) {
      return hn::ConcatOdd(d32, hn::BitCast(d32, b), hn::BitCast(d32, a));
    };
    return {odd(l.w10, h.w10), even(l.w10, h.w10), odd(l.w32, h.w32), even(l.w32, h.w32)};
  }
};

#endif

// words + 1/2, rounded once.
HWY_INLINE F middle_of(W words) {
  const Floats d;
  const Integers di;
  const auto high = hn::ConvertTo(d, hn::BitCast(di, hn::ShiftRight<16>(words)));
  const auto low = hn::ConvertTo(d, hn::BitCast(di, hn::And(words, hn::Set(Words(), 0xffffu))));
  return hn::Add(hn::Mul(high, hn::Set(d, 65536.0f)), hn::Add(low, hn::Set(d, 0.5f)));
}

// log((word + 1/2) / 2^32). Close to 1 the difference to 1 is taken from the integer, so that small results
// keep their digits.
HWY_INLINE F log_of_uniform(W words) {
  const Floats d;
  const Words dw;
  const Integers di;
  const auto is_large = hn::Gt(words, hn::Set(dw, 0xb504f333u));  // sqrt(1/2)
  const F value = middle_of(hn::IfThenElse(is_large, hn::Not(words), words));
  // value = (1 + x) 2^exponent with 1 + x in sqrt(1/2) .. sqrt(2)
  const auto bits = hn::BitCast(di, value);
  const auto exponent = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(di, 0x3f3504f3)));
  const F mantissa = hn::BitCast(d, hn::Sub(bits, hn::ShiftLeft<23>(exponent)));
  const auto large = hn::RebindMask(d, is_large);
  const F x =
      hn::IfThenElse(large, hn::Mul(value, hn::Set(d, -0x1p-32f)), hn::Sub(mantissa, hn::Set(d, 1.0f)));
  const F e = hn::IfThenZeroElse(large, hn::ConvertTo(d, hn::Sub(exponent, hn::Set(di, 32))));
  const F z = hn::Mul(x, x);
  F y = horner(d, x, hn::Set(d, 7.0376836292e-2f), -1.1514610310e-1, 1.1676998740e-1, -1.2420140846e-1,
               1.4249322787e-1, -1.6668057665e-1, 2.0000714765e-1, -2.4999993993e-1, 3.3333331174e-1);
  y = hn::Mul(hn::Mul(y, x), z);
  y = hn::Add(y, hn::Mul(e, hn::Set(d, -2.12194440e-4f)));
  y = hn::Sub(y, hn::Mul(z, hn::Set(d, 0.5f)));
  return hn::Add(hn::Add(x, y), hn::Mul(e, hn::Set(d, 0.693359375f)));
}

// Sine and cosine of 2 pi (word + 1/2) / 2^32: the quadrant is in the upper bits.
HWY_INLINE SineCosine<F> sine_cosine_of_turn(W words) {
  const Floats d;
  const Words dw;
  const Integers di;
  const W quadrant = hn::ShiftRight<30>(hn::Add(words, hn::Set(dw, 1u << 29)));
  const auto rest = hn::BitCast(di, hn::Sub(words, hn::ShiftLeft<30>(quadrant)));
  const F middle = hn::Add(hn::ConvertTo(d, rest), hn::Set(d, 0.5f));
  const auto [sine, cosine] = sine_cosine_core(d, hn::Mul(middle, hn::Set(d, 1.46291807926715968e-9f)), 0.0f);
  return in_quadrant(d, di, hn::BitCast(di, quadrant), sine, cosine);
}

// Box & Muller 1958.
HWY_INLINE void store_normal_pair(W first, W second, float* a, float* b) {
  const Floats d;
  const F radius = hn::Sqrt(hn::Mul(log_of_uniform(first), hn::Set(d, -2.0f)));
  const auto [sine, cosine] = sine_cosine_of_turn(second);
  hn::Store(hn::Mul(radius, cosine), d, a);
  hn::Store(hn::Mul(radius, sine), d, b);
}

// The words of the next items are made while those of the current ones become normal numbers: two long chains
// of operations side by side.
void fill_normals(const PhiloxCounter& first, const PhiloxKey& key, std::size_t count, NormalBatch& batch) {
  const std::size_t lanes = hn::Lanes(Floats());
  const Blocks blocks{first, key};
  WordsOfItems words = blocks.of_item(0);
  for (std::size_t i = 0; i < count; i += lanes) {
    const WordsOfItems next = blocks.of_item(i + lanes);
    store_normal_pair(words.w0, words.w1, &batch.number[0][i], &batch.number[1][i]);
    store_normal_pair(words.w2, words.w3, &batch.number[2][i], &batch.number[3][i]);
    words = next;
  }
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn {

HWY_EXPORT(fill_normals);

void NormalBatch::fill(const RandomStream& random, std::uint32_t first, std::size_t count,
                       std::uint16_t draw) {
  CAIRN_ASSERT(count <= kCapacity);
  HWY_DYNAMIC_DISPATCH(fill_normals)(random.counter(first, draw), random.key(), count, *this);
}

}  // namespace cairn
#endif  // HWY_ONCE
