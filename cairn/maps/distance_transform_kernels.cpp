#include "cairn/maps/distance_transform_kernels.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cairn/maps/distance_transform_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace cairn::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void distances_in_columns(const RowBand& s, std::int8_t occupied_from, std::uint8_t cap) {
  const hn::ScalableTag<std::uint8_t> d;
  const hn::RebindToSigned<decltype(d)> di;
  const std::size_t lanes = hn::Lanes(d);
  const auto threshold = hn::Set(di, occupied_from);
  const auto most = hn::Set(d, cap), one = hn::Set(d, 1);
  const std::size_t vectors_end = s.columns / lanes * lanes;
  for (std::size_t row = 0; row < s.rows; ++row) {
    const std::int8_t* cell = s.cells + row * s.columns;
    std::uint8_t* here = s.out + row * s.columns;
    const std::uint8_t* below = here - s.columns;  // read from the second row on
    for (std::size_t c = 0; c < vectors_end; c += lanes) {
      const auto before = row == 0 ? most : hn::LoadU(d, below + c);
      const auto free = hn::RebindMask(d, hn::Lt(hn::LoadU(di, cell + c), threshold));
      hn::StoreU(hn::IfThenElseZero(free, hn::Min(hn::SaturatedAdd(before, one), most)), d, here + c);
    }
    for (std::size_t c = vectors_end; c < s.columns; ++c) {
      const int before = row == 0 ? cap : below[c];
      here[c] = cell[c] >= occupied_from ? std::uint8_t{0}
                                         : static_cast<std::uint8_t>(std::min<int>(before + 1, cap));
    }
  }
  for (std::size_t row = s.rows - 1; row-- > 0;) {
    std::uint8_t* here = s.out + row * s.columns;
    const std::uint8_t* above = here + s.columns;
    for (std::size_t c = 0; c < vectors_end; c += lanes) {
      const auto through = hn::SaturatedAdd(hn::LoadU(d, above + c), one);
      hn::StoreU(hn::Min(hn::LoadU(d, here + c), through), d, here + c);
    }
    for (std::size_t c = vectors_end; c < s.columns; ++c)
      here[c] = static_cast<std::uint8_t>(std::min<int>(here[c], above[c] + 1));
  }
}

void least_in_windows(const std::uint16_t* squares, std::uint16_t far, int radius, std::uint16_t* out,
                      std::size_t columns) {
  constexpr int kStepsPerCheck = 4;
  const hn::ScalableTag<std::uint16_t> d;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t x = 0; x < columns; x += lanes) {
    auto best = hn::LoadU(d, squares + x);
    for (int k = 1; k <= radius;) {
      // No cell so far away can lower any lane.
      if (hn::AllFalse(d, hn::Gt(best, hn::Set(d, static_cast<std::uint16_t>(k * k))))) break;
      for (const int end = std::min(k + kStepsPerCheck, radius + 1); k < end; ++k) {
        const auto nearest = hn::Min(hn::LoadU(d, squares + x - k), hn::LoadU(d, squares + x + k));
        best = hn::Min(best, hn::SaturatedAdd(nearest, hn::Set(d, static_cast<std::uint16_t>(k * k))));
      }
    }
    hn::StoreU(hn::Min(best, hn::Set(d, far)), d, out + x);
  }
}

void square_row(const std::uint8_t* distances, std::uint8_t cap, std::uint16_t far, std::uint16_t* squares,
                std::size_t columns) {
  const hn::ScalableTag<std::uint16_t> d;
  const hn::Rebind<std::uint8_t, decltype(d)> narrow;
  const std::size_t lanes = hn::Lanes(d);
  const auto most = hn::Set(d, cap), beyond = hn::Set(d, far);
  for (std::size_t x = 0; x < columns; x += lanes) {
    const auto v = hn::PromoteTo(d, hn::LoadU(narrow, distances + x));
    hn::StoreU(hn::IfThenElse(hn::Eq(v, most), beyond, hn::Mul(v, v)), d, squares + x);
  }
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn {

HWY_EXPORT(distances_in_columns);
HWY_EXPORT(square_row);
HWY_EXPORT(least_in_windows);

void distances_in_columns(const RowBand& band, std::int8_t occupied_from, std::uint8_t cap) {
  HWY_DYNAMIC_DISPATCH(distances_in_columns)(band, occupied_from, cap);
}

void square_row(const std::uint8_t* distances, std::uint8_t cap, std::uint16_t far, std::uint16_t* squares,
                std::size_t columns) {
  HWY_DYNAMIC_DISPATCH(square_row)(distances, cap, far, squares, columns);
}

void least_in_windows(const std::uint16_t* squares, std::uint16_t far, int radius, std::uint16_t* out,
                      std::size_t columns) {
  HWY_DYNAMIC_DISPATCH(least_in_windows)(squares, far, radius, out, columns);
}

}  // namespace cairn
#endif  // HWY_ONCE
