// Philox4x32 on all lanes: see simd_math-inl.h for how this file is included.
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

#if HWY_TARGET != HWY_SCALAR

using PhiloxLongs = hn::ScalableTag<std::uint64_t>;

// Four words of as many blocks as there are 64-bit lanes. Only the lower half of each lane counts: the
// multiplication ignores what the shifts leave in the upper one.
struct PhiloxState {
  using Q = hn::Vec<PhiloxLongs>;
  Q c0, c1, c2, c3;

  static HWY_INLINE Q product(Q a, std::uint32_t factor) {
    const PhiloxLongs d;
    const hn::Repartition<std::uint32_t, PhiloxLongs> d32;
    return hn::MulEven(hn::BitCast(d32, a), hn::BitCast(d32, hn::Set(d, std::uint64_t{factor})));
  }

  // The keys go first to the words that are there early.
  HWY_INLINE void round(Q key0, Q key1) {
    const Q first = product(c0, kFactor0), second = product(c2, kFactor1);
    c0 = hn::Xor(hn::ShiftRight<32>(second), hn::Xor(c1, key0));
    c2 = hn::Xor(hn::ShiftRight<32>(first), hn::Xor(c3, key1));
    c1 = second;
    c3 = first;
  }

  static constexpr std::uint32_t kFactor0 = 0xD2511F53u, kFactor1 = 0xCD9E8D57u;
};

// The blocks of a counter whose first word is counted on, one block per lane.
template <int Rounds>
class PhiloxBlocks {
  using Q = PhiloxState::Q;

 public:
  HWY_INLINE PhiloxBlocks(const PhiloxCounter& first, const PhiloxKey& key)
      : first_(hn::Iota(PhiloxLongs(), first[0])) {
    std::uint32_t keys0[Rounds], keys1[Rounds];
    for (std::uint32_t r = 0; r < Rounds; ++r) {
      keys0[r] = key[0] + r * 0x9E3779B9u;
      keys1[r] = key[1] + r * 0xBB67AE85u;
      key0_[r] = set(keys0[r]);
      key1_[r] = set(keys1[r]);
    }
    const std::uint64_t product1 = std::uint64_t{first[2]} * PhiloxState::kFactor1;
    const auto word0 = static_cast<std::uint32_t>(product1 >> 32) ^ first[1] ^ keys0[0];
    const std::uint64_t product2 = std::uint64_t{word0} * PhiloxState::kFactor0;
    round1_ = set(first[3] ^ keys1[0]);
    round2_c0_ = set(static_cast<std::uint32_t>(product1) ^ keys0[1]);
    round2_c2_ = set(static_cast<std::uint32_t>(product2 >> 32) ^ keys1[1]);
    round3_ = set(static_cast<std::uint32_t>(product2) ^ keys1[2]);
  }

  // From block `block` on. All blocks have three words in common, and what the first rounds make of them.
  HWY_INLINE PhiloxState three_rounds(std::size_t block) const {
    const Q start = hn::Add(first_, hn::Set(PhiloxLongs(), std::uint64_t{block}));
    const Q product1 = PhiloxState::product(start, PhiloxState::kFactor0);
    const Q word2 = hn::Xor(hn::ShiftRight<32>(product1), round1_);
    const Q product2 = PhiloxState::product(word2, PhiloxState::kFactor1);
    const Q first =
        PhiloxState::product(hn::Xor(hn::ShiftRight<32>(product2), round2_c0_), PhiloxState::kFactor0);
    const Q second = PhiloxState::product(hn::Xor(product1, round2_c2_), PhiloxState::kFactor1);
    return {hn::Xor(hn::ShiftRight<32>(second), hn::Xor(product2, key0_[2])), second,
            hn::Xor(hn::ShiftRight<32>(first), round3_), first};
  }

  // Up to the last round but one, several states side by side: each is one long chain of operations.
  template <class... States>
  HWY_INLINE void middle_rounds(States&... states) const {
    HWY_UNROLL(10)
    for (int r = 3; r < Rounds - 1; ++r) (states.round(key0_[r], key1_[r]), ...);
  }

  // Pairs of words as they leave the last round: word 1 or 3 in the lower half of a lane, 0 or 2 in the
  // upper.
  struct Words {
    Q w10, w32;
  };
  HWY_INLINE Words last_round(const PhiloxState& s) const {
    const Q first = PhiloxState::product(s.c0, PhiloxState::kFactor0);
    const Q second = PhiloxState::product(s.c2, PhiloxState::kFactor1);
    return {hn::Xor(second, hn::ShiftLeft<32>(hn::Xor(s.c1, key0_[Rounds - 1]))),
            hn::Xor(first, hn::ShiftLeft<32>(hn::Xor(s.c3, key1_[Rounds - 1])))};
  }

 private:
  static HWY_INLINE Q set(std::uint32_t word) { return hn::Set(PhiloxLongs(), std::uint64_t{word}); }

  Q first_, round1_, round2_c0_, round2_c2_, round3_;
  Q key0_[Rounds], key1_[Rounds];
};

#endif

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAIRN_CORE_PHILOX_INL_H_
