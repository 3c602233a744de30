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

void fill_bytes(const PhiloxCounter& first, const PhiloxKey& key, std::uint8_t* bytes) {
  for (std::uint32_t b = 0; b < Normal3::kBlocks; ++b) {
    const PhiloxCounter words = philox4x32_7({first[0] + b, first[1], first[2], first[3]}, key);
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

// Three vectors of blocks side by side: one is a long chain of operations.
void fill_bytes(const PhiloxCounter& first, const PhiloxKey& key, std::uint8_t* HWY_RESTRICT bytes) {
  const PhiloxLongs d;
  const hn::Repartition<std::uint8_t, PhiloxLongs> d8;
  const std::size_t lanes = hn::Lanes(d);
  const PhiloxBlocks<7> blocks(first, key);
  const auto store = [&](const PhiloxState& s, std::size_t block) {
    const auto [w10, w32] = blocks.last_round(s);
    hn::Store(hn::BitCast(d8, w10), d8, bytes + 8 * block);
    hn::Store(hn::BitCast(d8, w32), d8, bytes + Normal3::kBytes / 2 + 8 * block);
  };
  static_assert(Normal3::kBlocks % (3 * hn::MaxLanes(PhiloxLongs())) == 0);
  for (std::size_t b = 0; b < Normal3::kBlocks; b += 3 * lanes) {
    PhiloxState low = blocks.three_rounds(b), middle = blocks.three_rounds(b + lanes);
    PhiloxState high = blocks.three_rounds(b + 2 * lanes);
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

void fill_group(const PhiloxCounter& first, const PhiloxKey& key, std::int16_t* n0, std::int16_t* n1,
                std::int16_t* n2) {
  HWY_ALIGN std::uint8_t bytes[Normal3::kBytes];
  fill_bytes(first, key, bytes);
  fill_numbers(bytes, n0);
  fill_numbers(bytes + Normal3::kBytes / 3, n1);
  fill_numbers(bytes + 2 * Normal3::kBytes / 3, n2);
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn {

HWY_EXPORT(fill_group);

void Normal3Batch::fill(const RandomStream& random, std::uint32_t first, std::size_t count,
                        std::uint16_t draw) {
  CAIRN_ASSERT(count <= kCapacity);
  PhiloxCounter blocks = random.counter(first, draw);
  const std::uint32_t group = blocks[0] / Normal3::kGroup;
  skipped_ = blocks[0] % Normal3::kGroup;
  for (std::uint32_t g = 0; std::size_t{g} * Normal3::kGroup < skipped_ + count; ++g) {
    blocks[0] = (group + g) * Normal3::kBlocks;
    const std::size_t at = g * std::size_t{Normal3::kGroup};
    HWY_DYNAMIC_DISPATCH(fill_group)
    (blocks, random.key(), &numbers_[0][at], &numbers_[1][at], &numbers_[2][at]);
  }
}

}  // namespace cairn
#endif  // HWY_ONCE
