#include "cairn/core/pose_cells.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"

#include <algorithm>
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

// A vector of poses, their doubles one after the other. Cells are whole numbers: as doubles they are exact.
HWY_INLINE void find_vector(const PoseCells& c, const double* poses, std::int32_t* out) {
  const Doubles d;
  const hn::Rebind<std::int32_t, Doubles> d32;
  D x, y, theta;
  hn::LoadInterleaved3(d, poses, x, y, theta);
  const D scale = hn::Set(d, c.cells_per_m), side = hn::Set(d, c.side), headings = hn::Set(d, c.headings);
  const D column = hn::Sub(hn::Floor(hn::Mul(x, scale)), hn::Set(d, c.first_x));
  const D row = hn::Sub(hn::Floor(hn::Mul(y, scale)), hn::Set(d, c.first_y));
  // 0 .. side - 1: no farther from the middle than its ends.
  const D middle = hn::Set(d, 0.5 * (c.side - 1));
  const auto inside = hn::And(hn::Le(hn::Abs(hn::Sub(column, middle)), middle),
                              hn::Le(hn::Abs(hn::Sub(row, middle)), middle));
  const auto is_heading = hn::And(hn::Ge(theta, hn::Set(d, -kPi)), hn::Lt(theta, hn::Set(d, kPi)));
  D turn = hn::Floor(hn::Mul(theta, hn::Set(d, c.headings / kTwoPi)));
  turn = hn::Add(turn, hn::IfThenElseZero(hn::Lt(turn, hn::Zero(d)), headings));
  const D cell = hn::Add(hn::Mul(hn::Add(hn::Mul(row, side), column), headings), turn);
  const D found = hn::IfThenElse(hn::And(inside, is_heading), cell, hn::Set(d, PoseCells::kNone));
  hn::StoreU(hn::DemoteTo(d32, found), d32, out);
}

void find_all(const PoseCells& cells, const double* poses, std::int32_t* out, std::size_t count) {
  constexpr std::size_t kLanes = hn::MaxLanes(Doubles());
  const PoseCells c = cells;  // not to be read again after each store
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) find_vector(c, poses + 3 * i, out + i);
  if (i == count) return;
  double rest[3 * kLanes] = {};
  std::int32_t found[kLanes];
  std::copy_n(poses + 3 * i, 3 * (count - i), rest);
  find_vector(c, rest, found);
  std::copy_n(found, count - i, out + i);
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn {

HWY_EXPORT(find_all);

std::int32_t PoseCells::cell_of(const Pose2& pose) const {
  const double column = std::floor(pose.x * cells_per_m) - first_x;
  const double row = std::floor(pose.y * cells_per_m) - first_y;
  const bool inside = column >= 0.0 && column < side && row >= 0.0 && row < side;
  if (!inside || !(pose.theta >= -kPi && pose.theta < kPi)) return kNone;
  const double turn = std::floor(pose.theta * (headings / kTwoPi));
  const double heading = turn < 0.0 ? turn + headings : turn;
  return static_cast<std::int32_t>((row * side + column) * headings + heading);
}

void find_cells(const PoseCells& cells, std::span<const Pose2> poses, std::span<std::int32_t> out) {
  CAIRN_ASSERT(out.size() == poses.size());
  static_assert(sizeof(Pose2) == 3 * sizeof(double));
  HWY_DYNAMIC_DISPATCH(find_all)(cells, &poses.data()->x, out.data(), poses.size());
}

}  // namespace cairn
#endif  // HWY_ONCE
