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

// The generators of group after group.
class Generators {
 public:
  Generators(const PhiloxCounter& first, const PhiloxKey& key, std::size_t) : next_(first), key_(key) {}

  void fill_group(std::size_t, std::uint8_t* bytes) {
    std::array<PhiloxCounter, Normal3::kBlocks> blocks;
    for (PhiloxCounter& block : blocks) block = philox4x32_7(next_, key_), ++next_[0];
    for (std::size_t g = 0; g < Normal3::kGenerators; ++g) {
      Sfc64 generator = Normal3::generator(blocks, g);
      for (std::size_t k = 8 * g; k < Normal3::kBytes; k += 8 * Normal3::kGenerators) {
        const std::uint64_t word = generator.next();
        for (std::size_t i = 0; i < 8; ++i) bytes[k + i] = static_cast<std::uint8_t>(word >> 8 * i);
      }
    }
  }

 private:
  PhiloxCounter next_;
  PhiloxKey key_;
};

void fill_numbers(const std::uint8_t* rows, std::int16_t* numbers) {
  for (std::size_t i = 0; i < Normal3::kGroup; ++i) {
    const std::uint8_t* a = rows + Normal3::column_of(i);
    numbers[i] = Normal3::from_bytes(a[0], a[Normal3::kGroup], a[std::size_t{2} * Normal3::kGroup]);
  }
}

#else

using Bytes = hn::ScalableTag<std::uint8_t>;
using B = hn::Vec<Bytes>;
using Longs = hn::CappedTag<std::uint64_t, Normal3::kGenerators>;
using L = hn::Vec<Longs>;
constexpr std::size_t kLongs = hn::MaxLanes(Longs());

// One generator per lane.
struct GeneratorLanes {
  L a, b, c;

  HWY_INLINE L next(L counter) {
    const L number = hn::Add(hn::Add(a, counter), b);
    a = hn::Xor(b, hn::ShiftRight<Sfc64::kRight>(b));
    b = hn::Add(c, hn::ShiftLeft<Sfc64::kLeft>(c));
    c = hn::Add(rotated(c), number);
    return number;
  }

 private:
  // By whole bytes: one shuffle where there is no rotation, in place of two shifts and their union.
  static HWY_INLINE L rotated(L v) {
#if HWY_TARGET <= HWY_AVX3
    return hn::RotateRight<64 - Sfc64::kRotation>(v);
#else
    static_assert(Sfc64::kRotation == 24);
    const hn::Repartition<std::uint8_t, Longs> d8;
    HWY_ALIGN static constexpr std::uint8_t kFrom[16] = {5,  6,  7,  0, 1, 2,  3,  4,
                                                         13, 14, 15, 8, 9, 10, 11, 12};
    return hn::BitCast(Longs(), hn::TableLookupBytes(hn::BitCast(d8, v), hn::LoadDup128(d8, kFrom)));
#endif
  }
};

// Several vectors of generators side by side: each is one long chain of operations.
template <class... Lanes>
HWY_INLINE void run_generators(std::uint8_t* HWY_RESTRICT bytes, Lanes... lanes) {
  const hn::Repartition<std::uint8_t, Longs> d8;
  for (std::size_t step = 0; step < Normal3::kSteps; ++step) {
    const L counter = hn::Set(Longs(), std::uint64_t{step} + 1);
    std::uint8_t* to = bytes + 8 * Normal3::kGenerators * step;
    ((hn::Store(hn::BitCast(d8, lanes.next(counter)), d8, to), to += 8 * kLongs), ...);
  }
}

// The generators of group after group: their Philox blocks are made all at once, three vectors of them side
// by side.
class Generators {
 public:
  HWY_INLINE Generators(const PhiloxCounter& first, const PhiloxKey& key, std::size_t groups) {
    const PhiloxLongs d;
    const PhiloxBlocks<7> blocks(first, key);
    const std::size_t lanes = hn::Lanes(d);
    const auto store = [&](const PhiloxState& s, std::size_t block) {
      const auto [w10, w32] = blocks.last_round(s);
      hn::Store(w10, d, words10_ + block);
      hn::Store(w32, d, words32_ + block);
    };
    for (std::size_t b = 0; b < groups * Normal3::kBlocks; b += 3 * lanes) {
      PhiloxState low = blocks.three_rounds(b), middle = blocks.three_rounds(b + lanes);
      PhiloxState high = blocks.three_rounds(b + 2 * lanes);
      blocks.middle_rounds(low, middle, high);
      store(low, b);
      store(middle, b + lanes);
      store(high, b + 2 * lanes);
    }
  }

  HWY_INLINE void fill_group(std::size_t group, std::uint8_t* HWY_RESTRICT bytes) const {
    const std::size_t first = group * Normal3::kBlocks;
    if constexpr (kLongs == Normal3::kGenerators) {
      run_generators(bytes, lanes_from(first, 0));
    } else {
      for (std::size_t g = 0; g < Normal3::kGenerators; g += 2 * kLongs)
        run_generators(bytes + 8 * g, lanes_from(first, g), lanes_from(first, g + kLongs));
    }
  }

 private:
  // Normal3::generator of g and those behind it, for the group whose blocks begin there.
  HWY_INLINE GeneratorLanes lanes_from(std::size_t first, std::size_t g) const {
    const Longs d;
    const L a = hn::LoadU(d, words10_ + first + g), b = hn::LoadU(d, words32_ + first + g);
    const std::size_t shared = first + Normal3::kGenerators;
    if constexpr (kLongs == Normal3::kGenerators) {
      const hn::Half<Longs> half;
      return {a, b, hn::Combine(d, hn::LoadU(half, words32_ + shared), hn::LoadU(half, words10_ + shared))};
    } else {
      return {a, b, hn::LoadU(d, (g < 4 ? words10_ : words32_) + shared + g % 4)};
    }
  }

  static constexpr std::size_t kAtOnce = 3 * hn::MaxLanes(PhiloxLongs());
  static constexpr std::size_t kMost =
      (Normal3Batch::kMostGroups * Normal3::kBlocks + kAtOnce - 1) / kAtOnce * kAtOnce;
  HWY_ALIGN std::uint64_t words10_[kMost], words32_[kMost];  // words 1 and 0, 3 and 2 of each block
};

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

// Several groups, whose blocks follow one another.
void fill_groups(const PhiloxCounter& first, const PhiloxKey& key, std::uint32_t groups,
                 Normal3Batch::Numbers& numbers) {
  HWY_ALIGN std::uint8_t bytes[Normal3::kBytes];
  Generators generators(first, key, groups);
  for (std::uint32_t g = 0; g < groups; ++g) {
    generators.fill_group(g, bytes);
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
