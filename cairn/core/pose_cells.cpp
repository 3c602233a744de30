#include "cairn/core/pose_cells.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cairn/core/pose_cells.cpp"
// Highway must come first.
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace cairn::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::ScalableTag<double>;
using D = hn::Vec<Doubles>;

constexpr std::size_t kLanes = hn::MaxLanes(Doubles());

// Adding 1.5 times 2^52 leaves whole numbers in the low bits of a double.
constexpr double kBias = 6755399441055744.0;
using Cells = hn::Vec<hn::RebindToUnsigned<Doubles>>;

HWY_INLINE Cells without_bias(D biased) {
  const hn::RebindToUnsigned<Doubles> du;
  return hn::Xor(hn::BitCast(du, biased), hn::BitCast(du, hn::Set(Doubles(), kBias)));
}

// Products of the low halves.
HWY_INLINE Cells times(Cells a, Cells b) {
#if HWY_TARGET == HWY_SCALAR
  constexpr std::uint64_t kLow = 0xffffffffU;
  return hn::Set(hn::RebindToUnsigned<Doubles>(), (hn::GetLane(a) & kLow) * (hn::GetLane(b) & kLow));
#else
  const hn::Repartition<std::uint32_t, hn::RebindToUnsigned<Doubles>> halves;
  return hn::MulEven(hn::BitCast(halves, a), hn::BitCast(halves, b));
#endif
}

// The cells of a vector of poses, their doubles one after the other; true where there is one.
HWY_INLINE hn::Mask<Doubles> find_cells(const PoseCells& c, const double* poses, Cells& cell) {
  const Doubles d;
  const hn::RebindToUnsigned<Doubles> du;
  D x, y, theta;
  hn::LoadInterleaved3(d, poses, x, y, theta);
  const auto side = static_cast<std::uint32_t>(c.side);
  const D scale = hn::Set(d, c.cells_per_m), bias = hn::Set(d, kBias);
  const Cells column = without_bias(hn::Add(hn::Floor(hn::Mul(x, scale)), hn::Set(d, kBias - c.first_x)));
  const Cells row = without_bias(hn::Add(hn::Floor(hn::Mul(y, scale)), hn::Set(d, kBias - c.first_y)));
  // 0 .. side - 1, a power of two: no bit but the lowest ones is set.
  const Cells beyond = hn::And(hn::Or(column, row), hn::Set(du, ~std::uint64_t{side - 1}));
  const auto is_heading = hn::Le(hn::Abs(theta), hn::Set(d, PoseCells::kLargestHeading));
  const D turn = hn::Floor(hn::Mul(theta, hn::Set(d, c.headings / kTwoPi)));
  const D first = hn::IfThenElse(hn::Lt(turn, hn::Zero(d)), hn::Set(d, kBias + c.headings), bias);
  const Cells place = hn::Add(hn::ShiftLeftSame(row, std::countr_zero(side)), column);
  cell = hn::Add(times(place, hn::Set(du, static_cast<std::uint64_t>(c.headings))),
                 without_bias(hn::Add(turn, first)));
  return hn::And(hn::RebindMask(d, hn::Eq(beyond, hn::Zero(du))), is_heading);
}

// As mark_cells has it. The cells of one vector are marked while the next ones are found.
struct Marker {
  const PoseCells cells;  // copies: not to be read again after each mark
  const std::uint8_t mark;
  std::uint8_t* const marks;
  std::uint32_t* const elsewhere;
  CellsMarked done;

  HWY_INLINE void put(std::uint64_t cell) {
    std::uint8_t& place = marks[cell];
    done.fresh += place != mark ? 1 : 0;
    place = mark;
  }

  // Poses of a belief share few cells: most have their mark.
  HWY_INLINE void put_all(const std::uint64_t* each) {
    bool known = true;
    HWY_UNROLL(8)
    for (std::size_t k = 0; k < kLanes; ++k) known = known && marks[each[k]] == mark;
    if (HWY_LIKELY(known)) return;
    for (std::size_t k = 0; k < kLanes; ++k) put(each[k]);
  }

  // The vector's first `count` poses; the first of all has this number.
  HWY_INLINE void add(const double* poses, std::size_t number, std::size_t count) {
    const Doubles d;
    const hn::RebindToUnsigned<Doubles> du;
    Cells cell;
    const auto found = find_cells(cells, poses, cell);
    HWY_ALIGN std::uint64_t each[kLanes];
    if (HWY_LIKELY(hn::AllTrue(d, found) && count == kLanes)) {
      hn::Store(cell, du, each);
      return put_all(each);
    }
    constexpr std::uint64_t kNowhere = ~std::uint64_t{0};
    hn::Store(hn::IfThenElse(hn::RebindMask(du, found), cell, hn::Set(du, kNowhere)), du, each);
    for (std::size_t k = 0; k < count; ++k) {
      if (each[k] != kNowhere) {
        put(each[k]);
      } else {
        elsewhere[done.elsewhere++] = static_cast<std::uint32_t>(number + k);
      }
    }
  }
};

CellsMarked mark_all(const PoseCells& cells, const double* poses, std::size_t count, std::uint8_t mark,
                     std::uint8_t* marks, std::uint32_t* elsewhere) {
  Marker marker{cells, mark, marks, elsewhere, {}};
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) marker.add(poses + 3 * i, i, kLanes);
  if (i == count) return marker.done;
  double rest[3 * kLanes] = {};
  std::copy_n(poses + 3 * i, 3 * (count - i), rest);
  marker.add(rest, i, count - i);
  return marker.done;
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn {

HWY_EXPORT(mark_all);

std::int32_t PoseCells::cell_of(const Pose2& pose) const {
  const double column = std::floor(pose.x * cells_per_m) - first_x;
  const double row = std::floor(pose.y * cells_per_m) - first_y;
  const bool inside = column >= 0.0 && column < side && row >= 0.0 && row < side;
  if (!inside || !(std::abs(pose.theta) <= kLargestHeading)) return kNone;
  const double turn = std::floor(pose.theta * (headings / kTwoPi));
  const double heading = turn < 0.0 ? turn + headings : turn;
  return static_cast<std::int32_t>((row * side + column) * headings + heading);
}

CellsMarked mark_cells(const PoseCells& cells, std::span<const Pose2> poses, std::uint8_t mark,
                       std::span<std::uint8_t> marks, std::span<std::uint32_t> elsewhere) {
  CAIRN_ASSERT(elsewhere.size() >= poses.size());
  CAIRN_ASSERT(std::has_single_bit(static_cast<std::uint32_t>(cells.side)));
  CAIRN_ASSERT(marks.size() >= static_cast<std::size_t>(cells.side) * cells.side * cells.headings);
  static_assert(sizeof(Pose2) == 3 * sizeof(double));
  if (poses.empty()) return {};
  return HWY_DYNAMIC_DISPATCH(mark_all)(cells, &poses.data()->x, poses.size(), mark, marks.data(),
                                        elsewhere.data());
}

}  // namespace cairn
#endif  // HWY_ONCE
