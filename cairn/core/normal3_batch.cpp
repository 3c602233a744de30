#include "cairn/core/normal3_batch.hpp"

#include "cairn/core/errors.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cairn/core/normal3_batch.cpp"
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
using F = hn::Vec<Floats>;
using W = hn::Vec<Words>;

constexpr std::size_t kMostBlocks = 48;  // of 160 items, four to a block

// The words of `blocks` blocks, one block after the other, rounded up to a multiple of sixteen: they fill two
// vectors of 512 bits.
void store_words(const PhiloxCounter first, const PhiloxKey key, std::size_t blocks,
                 std::uint32_t* HWY_RESTRICT words) {
#if HWY_TARGET == HWY_SCALAR
  for (std::size_t b = 0; b < blocks; ++b) {
    const auto item = first[0] + static_cast<std::uint32_t>(b);
    const PhiloxCounter block = philox4x32_10({item, first[1], first[2], first[3]}, key);
    for (std::size_t k = 0; k < 4; ++k) words[4 * b + k] = block[k];
  }
#else
  const PhiloxLongs d;
  const Words d32;
  const std::size_t lanes = hn::Lanes(d);
  const PhiloxKeys keys(key);
  // Interleaving brings the blocks of the even lanes together, and those of the odd ones.
  const auto lane = hn::Iota(d, 0);
  const auto half = hn::Mul(hn::And(lane, hn::Set(d, 1)), hn::Set(d, lanes / 2));
  const auto offsets = hn::Add(hn::ShiftRight<1>(lane), half);
  const auto store = [&](const PhiloxState& s, std::uint32_t* out) {
    const auto join = [&](PhiloxState::Q odd, PhiloxState::Q even) {
      return hn::BitCast(d, hn::OddEven(hn::BitCast(d32, hn::ShiftLeft<32>(odd)), hn::BitCast(d32, even)));
    };
    const auto w01 = join(s.c1, s.c0), w23 = join(s.c3, s.c2);
    hn::Store(hn::BitCast(d32, hn::InterleaveLower(d, w01, w23)), d32, out);
    hn::Store(hn::BitCast(d32, hn::InterleaveUpper(d, w01, w23)), d32, out + 2 * lanes);
  };
  for (std::size_t b = 0; b < blocks; b += 2 * lanes) {
    const PhiloxPair pair(first, keys, static_cast<std::uint32_t>(b), offsets);
    store(pair.low, words + 4 * b);
    store(pair.high, words + 4 * (b + lanes));
  }
#endif
}

struct NormalPair {
  F first, second;
};

// sqrt(-log u) of u = (n + 1/2) / 2^20, with n in bits 10 to 29 of the word. The polynomial is the minimax
// one of -log(1 + x) / x between sqrt(1/2) - 1 and sqrt(2) - 1: 5e-5 of the logarithm.
HWY_INLINE F radius_of(W word) {
  const Floats d;
  const Words dw;
  const hn::RebindToSigned<Floats> di;
  const auto n = hn::Or(hn::And(word, hn::Set(dw, 0x3ffffc00u)), hn::Set(dw, 0x200u));
  // 2^30 u = (1 + x) 2^exponent
  const auto bits = hn::BitCast(di, hn::ConvertTo(d, hn::BitCast(di, n)));
  const auto exponent = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(di, 0x3f3504f3)));
  const F x = hn::Sub(hn::BitCast(d, hn::Sub(bits, hn::ShiftLeft<23>(exponent))), hn::Set(d, 1.0f));
  const F q =
      horner(d, x, hn::Set(d, -0.1810292928f), 0.2720335690, -0.3359325812, 0.4993865011, -0.9999728323);
  const F halvings = hn::ConvertTo(d, hn::Sub(hn::Set(di, 30), exponent));
  return hn::Sqrt(hn::Add(hn::Mul(x, q), hn::Mul(halvings, hn::Set(d, 0.69314718056f))));
}

// Box & Muller 1958, with a direction of 12 bits: ten within a quadrant, one sign for each number. In a
// quadrant the angle is pi/4 + t: cosine and sine are those of t, their difference and sum, over sqrt(2).
HWY_INLINE NormalPair normal_pair(W word) {
  const Floats d;
  const Words dw;
  const hn::RebindToSigned<Floats> di;
  constexpr double kPerStep = 1.57079632679489662 / 1024.0;
  const F step = hn::ConvertTo(d, hn::BitCast(di, hn::And(word, hn::Set(dw, 0x3ffu))));
  const F t = hn::Add(hn::Mul(step, hn::Set(d, static_cast<float>(kPerStep))),
                      hn::Set(d, static_cast<float>(-511.5 * kPerStep)));
  const F z = hn::Mul(t, t);
  const F sine = hn::Mul(t, horner(d, z, hn::Set(d, 0.008151635578f), -0.1666248017, 0.9999985694));
  const F cosine = horner(d, z, hn::Set(d, 0.04039853597f), -0.4997081404, 0.9999900350);
  const F radius = radius_of(word);
  const W sign = hn::Set(dw, 0x80000000u);
  return {
      hn::Xor(hn::Mul(radius, hn::Sub(cosine, sine)), hn::BitCast(d, hn::And(word, sign))),
      hn::Xor(hn::Mul(radius, hn::Add(cosine, sine)), hn::BitCast(d, hn::And(hn::Add(word, word), sign)))};
}

// Whole groups of 32 items, of which the first has number `first[0]` in units of its blocks.
void fill_groups(const PhiloxCounter& pairs, const PhiloxCounter& thirds, const PhiloxKey& key,
                 std::size_t groups, float* n0, float* n1, float* n2) {
  constexpr std::size_t kGroup = RandomStream::kNormal3Group;
  const Floats d;
  HWY_ALIGN std::uint32_t words[4 * kMostBlocks];
  store_words(pairs, key, groups * kGroup / 4, words);
  for (std::size_t i = 0; i < groups * kGroup; i += hn::Lanes(d)) {
    const NormalPair pair = normal_pair(hn::Load(Words(), words + i));
    hn::Store(pair.first, d, n0 + i);
    hn::Store(pair.second, d, n1 + i);
  }
  store_words(thirds, key, groups * kGroup / 8, words);
  for (std::size_t g = 0; g < groups; ++g) {
    for (std::size_t i = 0; i < kGroup / 2; i += hn::Lanes(d)) {
      const NormalPair pair = normal_pair(hn::Load(Words(), words + g * kGroup / 2 + i));
      hn::Store(pair.first, d, n2 + g * kGroup + i);
      hn::Store(pair.second, d, n2 + g * kGroup + kGroup / 2 + i);
    }
  }
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn {

HWY_EXPORT(fill_groups);

void Normal3Batch::fill(const RandomStream& random, std::uint32_t first, std::size_t count,
                        std::uint16_t draw) {
  CAIRN_ASSERT(count <= kCapacity);
  PhiloxCounter pairs = random.counter(first, draw);
  PhiloxCounter thirds = random.counter(first, static_cast<std::uint16_t>(draw + 1));
  const std::uint32_t group = pairs[0] / kGroup;
  skipped_ = pairs[0] % kGroup;
  pairs[0] = group * (kGroup / 4);
  thirds[0] = group * (kGroup / 8);
  const std::size_t groups = (skipped_ + count + kGroup - 1) / kGroup;
  HWY_DYNAMIC_DISPATCH(fill_groups)
  (pairs, thirds, random.key(), groups, numbers_[0].data(), numbers_[1].data(), numbers_[2].data());
}

}  // namespace cairn
#endif  // HWY_ONCE
