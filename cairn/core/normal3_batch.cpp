#include "cairn/core/normal3_batch.hpp"

#include "cairn/core/errors.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cairn/core/normal3_batch.cpp"
// Highway must come first.
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "cairn/core/philox-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace cairn::HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR

struct Blocks {
  PhiloxCounter first;
  PhiloxKey key;
};

void fill_bytes(const Blocks& blocks, std::size_t begin, std::uint8_t* bytes) {
  PhiloxCounter counter = blocks.first;
  counter[0] += static_cast<std::uint32_t>(begin);
  for (std::uint32_t b = 0; b < Normal3::kBlocks; ++b, ++counter[0]) {
    const PhiloxCounter words = philox4x32_7(counter, blocks.key);
    for (std::size_t k = 0; k < 8; ++k) {
      const int shift = static_cast<int>(k % 4 * 8);
      bytes[8 * b + k] = static_cast<std::uint8_t>(words[k < 4 ? 1 : 0] >> shift);
      bytes[Normal3::kBytes / 2 + 8 * b + k] = static_cast<std::uint8_t>(words[k < 4 ? 3 : 2] >> shift);
    }
  }
}

void fill_numbers(const std::uint8_t* rows, std::int16_t* numbers) {
  for (std::size_t i = 0; i < Normal3::kGroup; ++i) {
    const std::uint8_t* a = rows + Normal3::column_of(i);
    numbers[i] = Normal3::from_bytes(a[0], a[Normal3::kGroup], a[std::size_t{2} * Normal3::kGroup]);
  }
}

#else

using Bytes = hn::ScalableTag<std::uint8_t>;
using B = hn::Vec<Bytes>;
using Blocks = PhiloxBlocks<7>;

// Three vectors of blocks side by side: one is a long chain of operations.
HWY_INLINE void fill_bytes(const Blocks& blocks, std::size_t begin, std::uint8_t* HWY_RESTRICT bytes) {
  const PhiloxLongs d;
  const hn::Repartition<std::uint8_t, PhiloxLongs> d8;
  const std::size_t lanes = hn::Lanes(d);
  const auto store = [&](const PhiloxState& s, std::size_t block) {
    const auto [w10, w32] = blocks.last_round(s);
    hn::Store(hn::BitCast(d8, w10), d8, bytes + 8 * block);
    hn::Store(hn::BitCast(d8, w32), d8, bytes + Normal3::kBytes / 2 + 8 * block);
  };
  static_assert(Normal3::kBlocks % (3 * hn::MaxLanes(PhiloxLongs())) == 0);
  for (std::size_t b = 0; b < Normal3::kBlocks; b += 3 * lanes) {
    PhiloxState low = blocks.three_rounds(begin + b), middle = blocks.three_rounds(begin + b + lanes);
    PhiloxState high = blocks.three_rounds(begin + b + 2 * lanes);
    blocks.middle_rounds(low, middle, high);
    store(low, b);
    store(middle, b + lanes);
    store(high, b + 2 * lanes);
  }
}

// Sixteen places of a table at once.
HWY_INLINE B look_up(B table, B places) { return hn::TableLookupBytes(table, places); }

void fill_numbers(const std::uint8_t* HWY_RESTRICT rows, std::int16_t* HWY_RESTRICT numbers) {
  const Bytes d;
  const hn::Repartition<std::int16_t, Bytes> d16;
  const auto table = [&](std::size_t k) {
    HWY_ALIGN std::uint8_t values[16];
    for (std::size_t i = 0; i < 16; ++i) values[i] = static_cast<std::uint8_t>(Normal3::kTables[k][i]);
    return hn::LoadDup128(d, values);
  };
  const B t0 = table(0), t1 = table(1), t2 = table(2), t3 = table(3), t4 = table(4);
  const B low_bits = hn::Set(d, 15), high_bits = hn::Set(d, 0xf0), half = hn::Set(d, 8);
  const auto low = [&](B bytes) { return hn::And(bytes, low_bits); };
  const auto high = [&](B bytes) {
    return hn::And(hn::BitCast(d, hn::ShiftRight<4>(hn::BitCast(d16, bytes))), low_bits);
  };
  for (std::size_t i = 0; i < Normal3::kGroup; i += hn::Lanes(d)) {
    const B a = hn::Load(d, rows + i), b = hn::Load(d, rows + Normal3::kGroup + i);
    const B c = hn::Load(d, rows + std::size_t{2} * Normal3::kGroup + i);
    const B of_a = hn::Add(look_up(t0, low(a)), look_up(t1, high(a)));
    const B of_b = hn::Add(look_up(t2, low(b)), look_up(t3, high(b)));
    const B sum = hn::Add(hn::Add(of_a, of_b), look_up(t4, low(c)));
    const B fraction = hn::Or(hn::And(c, high_bits), half);
    hn::Store(hn::BitCast(d16, hn::InterleaveLower(d, fraction, sum)), d16, numbers + i / 2);
    hn::Store(hn::BitCast(d16, hn::InterleaveUpper(d, fraction, sum)), d16,
              numbers + Normal3::kGroup / 2 + i / 2);
  }
}

#endif

// Several groups, whose blocks follow one another: what they have in common is computed once.
void fill_groups(const PhiloxCounter& first, const PhiloxKey& key, std::uint32_t groups,
                 Normal3Batch::Numbers& numbers) {
  HWY_ALIGN std::uint8_t bytes[Normal3::kBytes];
  const Blocks blocks{first, key};
  for (std::uint32_t g = 0; g < groups; ++g) {
    fill_bytes(blocks, std::size_t{g} * Normal3::kBlocks, bytes);
    for (std::size_t k = 0; k < numbers.size(); ++k)
      fill_numbers(bytes + k * Normal3::kBytes / 3, &numbers[k][std::size_t{g} * Normal3::kGroup]);
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
  if (count == 0) return;
  PhiloxCounter blocks = random.counter(first, draw);
  const std::uint32_t group = blocks[0] / Normal3::kGroup;
  skipped_ = blocks[0] % Normal3::kGroup;
  blocks[0] = group * Normal3::kBlocks;
  const auto groups = static_cast<std::uint32_t>((skipped_ + count - 1) / Normal3::kGroup + 1);
  HWY_DYNAMIC_DISPATCH(fill_groups)(blocks, random.key(), groups, numbers_);
}

}  // namespace cairn
#endif  // HWY_ONCE
