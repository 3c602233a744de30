#include "cairn/bayes/resampling/systematic.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cairn/bayes/resampling/systematic.cpp"
// Highway must come first.
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

#ifndef CAIRN_BAYES_RESAMPLING_SYSTEMATIC_COMB_
#define CAIRN_BAYES_RESAMPLING_SYSTEMATIC_COMB_
namespace cairn {
namespace {

// Adding 1.5 times 2^52 leaves whole numbers in the low bits of a double.
constexpr double kBias = 6755399441055744.0;

struct Comb {
  double teeth;   // per 1
  double offset;  // of the first one

  // Tooth t lies at (t + offset) / teeth: so many lie below `end`.
  std::size_t below(double end) const { return static_cast<std::size_t>(std::ceil(end * teeth - offset)); }
};

}  // namespace
}  // namespace cairn
#endif

HWY_BEFORE_NAMESPACE();
namespace cairn::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Replaces each number by the largest one up to it.
HWY_INLINE void spread_largest(std::uint32_t* numbers, std::size_t count) {
  std::size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
  const hn::FixedTag<std::uint32_t, 4> d;
  auto before = hn::Zero(d);
  for (; i + 4 <= count; i += 4) {
    auto largest = hn::LoadU(d, numbers + i);
    largest = hn::Max(largest, hn::ShiftLeftLanes<1>(largest));
    largest = hn::Max(largest, hn::ShiftLeftLanes<2>(largest));
    hn::StoreU(hn::Max(largest, before), d, numbers + i);
    before =
        hn::Max(hn::Broadcast<3>(largest), before);  // the one operation that waits for the vector before
  }
#endif
  for (; i < count; ++i) numbers[i] = i > 0 ? std::max(numbers[i - 1], numbers[i]) : numbers[i];
}

// Index i begins where the one before ends: there it is noted, over those before it that are not drawn at
// all, and then spread up to the next one. No branch depends on how often an index is drawn.
// @param out `count` zeros, and one place more
void draw_comb(std::span<const double> cumulative, std::size_t count, const Comb& comb, std::uint32_t* out) {
  const hn::ScalableTag<double> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  constexpr std::size_t kLanes = hn::MaxLanes(d);
  const auto teeth = hn::Set(d, comb.teeth), offset = hn::Set(d, comb.offset);
  const auto bias = hn::Set(d, kBias);
  const auto bits = hn::BitCast(du, bias);
  std::size_t drawn = 0, i = 0;
  for (; i + kLanes <= cumulative.size(); i += kLanes) {
    const auto ends = hn::Ceil(hn::Sub(hn::Mul(hn::LoadU(d, cumulative.data() + i), teeth), offset));
    HWY_ALIGN std::uint64_t each[kLanes];
    hn::Store(hn::Xor(hn::BitCast(du, hn::Add(ends, bias)), bits), du, each);
    HWY_UNROLL(8)
    for (std::size_t k = 0; k < kLanes; ++k) {
      out[drawn] = static_cast<std::uint32_t>(i + k);
      drawn = each[k];
    }
  }
  for (; i < cumulative.size(); ++i) {
    out[drawn] = static_cast<std::uint32_t>(i);
    drawn = comb.below(cumulative[i]);
  }
  spread_largest(out, count);
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn {
namespace {

HWY_EXPORT(draw_comb);

}  // namespace

void draw_systematic(std::span<const double> cumulative, std::size_t count, double offset,
                     std::vector<std::uint32_t>& ancestors) {
  const std::size_t first = ancestors.size();
  ancestors.resize(first + count + 1);
  const Comb comb{static_cast<double>(count), offset};
  HWY_DYNAMIC_DISPATCH(draw_comb)(cumulative, count, comb, ancestors.data() + first);
  ancestors.resize(first + count);
}

}  // namespace cairn
#endif  // HWY_ONCE
