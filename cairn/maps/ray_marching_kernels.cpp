#include "cairn/maps/ray_marching_kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cairn/maps/ray_marching_kernels.cpp"
// Highway must come first.
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace cairn::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using F = hn::Vec<Floats>;
using Words = hn::RebindToUnsigned<Floats>;

HWY_INLINE F all(float value) { return hn::Set(Floats(), value); }

// A vector of rays on their way.
struct Rays {
  F x, y, dx, dy, per_dx, per_dy;
  F to_far_column, to_far_row;  // from a cell's number to its far side, seen from the origin
  F length;

  HWY_INLINE F column() const { return hn::Floor(hn::Add(x, hn::Mul(length, dx))); }
  HWY_INLINE F row() const { return hn::Floor(hn::Add(y, hn::Mul(length, dy))); }
};

// No direction is zero, so that none divides by it.
HWY_INLINE F away_from_zero(F direction) {
  const F least = all(1e-12f);
  return hn::IfThenElse(hn::Lt(hn::Abs(direction), least), least, direction);
}

// 1 if the far side of a cell is the upper one, 0 if it is the lower one.
HWY_INLINE F far_side(F direction) {
  return hn::IfThenElseZero(hn::Gt(direction, hn::Zero(Floats())), all(1.0f));
}

HWY_INLINE Rays start(const StepPlaneView& plane, const RayOrigins& origins, std::size_t i, float cosine,
                      float sine) {
  const Floats d;
  const F c = hn::Load(d, &origins.cosine[i]), s = hn::Load(d, &origins.sine[i]);
  const F bc = all(cosine), bs = all(sine);
  Rays rays;
  rays.x = hn::Load(d, &origins.x[i]), rays.y = hn::Load(d, &origins.y[i]);
  rays.dx = away_from_zero(hn::Sub(hn::Mul(c, bc), hn::Mul(s, bs)));
  rays.dy = away_from_zero(hn::Add(hn::Mul(s, bc), hn::Mul(c, bs)));
  rays.per_dx = hn::Div(all(1.0f), rays.dx), rays.per_dy = hn::Div(all(1.0f), rays.dy);
  rays.to_far_column = hn::Sub(far_side(rays.dx), rays.x);
  rays.to_far_row = hn::Sub(far_side(rays.dy), rays.y);
  rays.length = hn::Min(hn::Load(d, &origins.free[i]), all(plane.max_range));
  return rays;
}

// Where cells lie in memory. Adding 2^23 puts a whole number into the low bits of a float.
class CellPlaces {
 public:
  HWY_INLINE explicit CellPlaces(const StepPlaneView& plane)
      : columns_(hn::Set(Words(), plane.columns)),
        first_(hn::Set(Words(), kBits * plane.columns + kBits)),
        last_(hn::Set(Words(), plane.columns * plane.rows - 1)) {}

  HWY_INLINE hn::Vec<Words> of(F column, F row) const {
    const F bias = all(8388608.0f);
    const auto c = hn::BitCast(Words(), hn::Add(column, bias)), r = hn::BitCast(Words(), hn::Add(row, bias));
    const auto place = hn::Sub(hn::Add(hn::Mul(r, columns_), c), first_);
    return hn::Min(place, last_);  // no ray leaves the border: but if one did, nothing else would be read
  }

 private:
  static constexpr std::uint32_t kBits = 0x4B000000;  // of 2^23
  hn::Vec<Words> columns_, first_, last_;
};

// One step of every ray, to where it leaves its cell at least; those at their end stay. True if all are.
HWY_INLINE bool advance(const CellPlaces& places, const StepPlaneView& plane, Rays& rays) {
  const Floats d;
  const hn::RebindToSigned<Floats> di;
  const F column = rays.column(), row = rays.row(), before = rays.length;
  const auto place = hn::BitCast(di, places.of(column, row));
  const auto around = hn::GatherOffset(di, reinterpret_cast<const std::int32_t*>(plane.steps), place);
  const auto code = hn::And(around, hn::Set(di, 0xff));
  // A code is one step more than is safe: `beyond` has that taken off.
  const F safe = hn::Add(before, hn::Mul(hn::ConvertTo(d, code), all(kCellsPerStep)));
  const F exit = hn::Min(hn::Mul(hn::Add(column, rays.to_far_column), rays.per_dx),
                         hn::Mul(hn::Add(row, rays.to_far_row), rays.per_dy));
  const F farther = hn::Max(safe, hn::Add(exit, all(kCellsPerStep)));
  const F next = hn::Min(hn::Add(farther, all(plane.beyond)), all(plane.max_range));
  const auto ended = hn::RebindMask(d, hn::Eq(code, hn::Zero(di)));
  rays.length = hn::IfThenElse(ended, before, next);
  return hn::AllTrue(d, hn::Eq(rays.length, before));
}

// The length at which a ray enters the cell where it is, along one axis.
HWY_INLINE F entry(F cell, F origin, F direction, F per_direction) {
  const F near_side = hn::Sub(all(1.0f), far_side(direction));
  return hn::Mul(hn::Sub(hn::Add(cell, near_side), origin), per_direction);
}

// The range at which each ray entered the cell where it ended; the largest one if that is the border.
HWY_INLINE F range_of_wall(const StepPlaneView& plane, const Rays& rays) {
  const Floats d;
  const F column = rays.column(), row = rays.row(), none = hn::Zero(d);
  const F entered =
      hn::Max(entry(column, rays.x, rays.dx, rays.per_dx), entry(row, rays.y, rays.dy, rays.per_dy));
  const F length = hn::Min(hn::Max(entered, none), rays.length);
  const auto outside = hn::Or(hn::Or(hn::Le(column, none), hn::Le(row, none)),
                              hn::Or(hn::Ge(column, all(static_cast<float>(plane.columns - 1))),
                                     hn::Ge(row, all(static_cast<float>(plane.rows - 1)))));
  const auto unmet = hn::Or(outside, hn::Ge(rays.length, all(plane.max_range)));
  return hn::IfThenElse(unmet, all(plane.max_range_m), hn::Mul(length, all(plane.metres)));
}

// Four vectors of rays at once, so that the memory accesses of one pass while the others compute; those whose
// rays have all ended are left alone.
void march(const StepPlaneView& view, const RayOrigins& origins, float cosine, float sine,
           std::array<float, RayOrigins::kCapacity>& ranges_m) {
  const Floats d;
  constexpr std::size_t kLanes = hn::MaxLanes(Floats());
  StepPlaneView plane = view;
  plane.beyond -= kCellsPerStep;
  const CellPlaces places(plane);
  for (std::size_t i = 0; i < RayOrigins::kCapacity; i += 4 * kLanes) {
    Rays rays[4];
    for (std::size_t k = 0; k < 4; ++k) rays[k] = start(plane, origins, i + k * kLanes, cosine, sine);
    bool ended[4] = {};
    do {
      HWY_UNROLL(4)
      for (std::size_t k = 0; k < 4; ++k) {
        if (!ended[k]) ended[k] = advance(places, plane, rays[k]);
      }
    } while (!(ended[0] && ended[1] && ended[2] && ended[3]));
    for (std::size_t k = 0; k < 4; ++k)
      hn::StoreU(range_of_wall(plane, rays[k]), d, &ranges_m[i + k * kLanes]);
  }
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn {

HWY_EXPORT(march);

void march(const StepPlaneView& plane, const RayOrigins& origins, float bearing_cosine, float bearing_sine,
           std::array<float, RayOrigins::kCapacity>& ranges_m) {
  HWY_DYNAMIC_DISPATCH(march)(plane, origins, bearing_cosine, bearing_sine, ranges_m);
}

}  // namespace cairn
#endif  // HWY_ONCE
