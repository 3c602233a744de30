// Philox4x32-10 on all lanes: see simd_math-inl.h for how this file is included.
#if defined(CAIRN_CORE_PHILOX_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAIRN_CORE_PHILOX_INL_H_
#undef CAIRN_CORE_PHILOX_INL_H_
#else
#define CAIRN_CORE_PHILOX_INL_H_
#endif

#include "cairn/core/rng.hpp"

#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace cairn::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

using PhiloxKeys = PhiloxKey;

#else

using PhiloxLongs = hn::ScalableTag<std::uint64_t>;

// Four words of as many blocks as there are 64-bit lanes. Only the lower half of each lane counts: the
// multiplication ignores what the shifts leave in the upper one.
struct PhiloxState {
  using Q = hn::Vec<PhiloxLongs>;
  Q c0, c1, c2, c3;

  HWY_INLINE void round(Q key0, Q key1) {
    const PhiloxLongs d;
    const hn::Repartition<std::uint32_t, PhiloxLongs> d32;
    const auto product = [&](Q a, std::uint64_t factor) {
      return hn::MulEven(hn::BitCast(d32, a), hn::BitCast(d32, hn::Set(d, factor)));
    };
    const Q first = product(c0, 0xD2511F53u), second = product(c2, 0xCD9E8D57u);
    // The keys go first to the words that are there early.
    c0 = hn::Xor(hn::ShiftRight<32>(second), hn::Xor(c1, key0));
    c2 = hn::Xor(hn::ShiftRight<32>(first), hn::Xor(c3, key1));
    c1 = second;
    c3 = first;
  }
};

// The keys of all rounds, ready in every lane.
struct PhiloxKeys {
  static constexpr int kRounds = 10;

  HWY_INLINE explicit PhiloxKeys(const PhiloxKey& key) {
    for (int r = 0; r < kRounds; ++r) {
      const auto step = static_cast<std::uint32_t>(r);
      first[r] = hn::Set(PhiloxLongs(), std::uint64_t{key[0] + step * 0x9E3779B9u});
      second[r] = hn::Set(PhiloxLongs(), std::uint64_t{key[1] + step * 0xBB67AE85u});
    }
  }

  PhiloxState::Q first[kRounds];
  PhiloxState::Q second[kRounds];
};

// The words of the blocks first[0] + item + offsets, one block per lane: twice as many as there are lanes,
// two halves side by side.
struct PhiloxPair {
  PhiloxState low, high;

  HWY_INLINE PhiloxPair(const PhiloxCounter& first, const PhiloxKeys& keys, std::uint32_t item,
                        PhiloxState::Q offsets) {
    const PhiloxLongs d;
    const auto start = [&](std::uint64_t block) {
      return PhiloxState{hn::Add(hn::Set(d, block), offsets), hn::Set(d, std::uint64_t{first[1]}),
                         hn::Set(d, std::uint64_t{first[2]}), hn::Set(d, std::uint64_t{first[3]})};
    };
    low = start(std::uint64_t{first[0]} + item);
    high = start(std::uint64_t{first[0]} + item + hn::Lanes(d));
    HWY_UNROLL(10)
    for (int r = 0; r < PhiloxKeys::kRounds; ++r) {
      low.round(keys.first[r], keys.second[r]);
      high.round(keys.first[r], keys.second[r]);
    }
  }
};

#endif

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAIRN_CORE_PHILOX_INL_H_
