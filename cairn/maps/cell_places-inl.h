// Where points of a grid lie in memory, on all lanes: see simd_math-inl.h for how this file is included.
#if defined(CAIRN_MAPS_CELL_PLACES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CAIRN_MAPS_CELL_PLACES_INL_H_
#undef CAIRN_MAPS_CELL_PLACES_INL_H_
#else
#define CAIRN_MAPS_CELL_PLACES_INL_H_
#endif

#include <algorithm>
#include <bit>
#include <cstdint>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace cairn::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Turns points (in cells) into the places of their cells, row by row; points off the grid into those of its
// first or last row and column, which hence are to be a border that stands for everything outside.
//
// Adding a power of two puts the cell's number into the upper bits of the float's mantissa, the fraction of a
// cell below: a shift, in place of a rounding and a conversion.
class Places {
 public:
  using Floats = hn::ScalableTag<float>;
  using Words = hn::RebindToUnsigned<Floats>;
  using F = hn::Vec<Floats>;
  using W = hn::Vec<Words>;

  // Neither side longer than 2^20.
  HWY_INLINE Places(std::uint32_t columns, std::uint32_t rows)
      : shift_(23 - static_cast<int>(std::bit_width(std::max(columns, rows)))),
        bias_(hn::Set(Floats(), static_cast<float>(1 << (23 - shift_)))),
        last_column_(hn::Set(Floats(), static_cast<float>(columns - 1))),
        last_row_(hn::Set(Floats(), static_cast<float>(rows - 1))),
        columns_(hn::Set(Words(), columns)) {
    const std::uint32_t zero = hn::GetLane(hn::BitCast(Words(), bias_)) >> shift_;
    zero_ = hn::Set(Words(), zero);
    zero_place_ = hn::Set(Words(), zero * columns + zero);  // modulo 2^32, as all of it
  }

  HWY_INLINE W of(F column, F row) const {
    const W place = hn::Add(hn::Mul(biased(row, last_row_), columns_), biased(column, last_column_));
    return hn::Sub(place, zero_place_);
  }
  HWY_INLINE W column_of(F column) const { return hn::Sub(biased(column, last_column_), zero_); }
  HWY_INLINE W row_of(F row) const { return hn::Sub(biased(row, last_row_), zero_); }

 private:
  HWY_INLINE W biased(F cells, F last) const {
    const F within = hn::Min(hn::Max(cells, hn::Zero(Floats())), last);
    return hn::ShiftRightSame(hn::BitCast(Words(), hn::Add(within, bias_)), shift_);
  }

  int shift_;
  F bias_, last_column_, last_row_;
  W columns_, zero_, zero_place_;
};

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAIRN_MAPS_CELL_PLACES_INL_H_
