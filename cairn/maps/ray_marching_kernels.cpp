#include "cairn/maps/ray_marching_kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cairn/maps/ray_marching_kernels.cpp"
// Highway must come first.
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "cairn/maps/cell_places-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace cairn::HWY_NAMESPACE {

using F = Places::F;

// A vector of rays on their way.
struct Rays {
  F x, y, dx, dy, per_dx, per_dy, length;

  HWY_INLINE F column() const { return hn::Add(x, hn::Mul(length, dx)); }
  HWY_INLINE F row() const { return hn::Add(y, hn::Mul(length, dy)); }
};

// No direction is zero, so that none divides by it.
HWY_INLINE F away_from_zero(F direction) {
  const Places::Floats d;
  const F least = hn::Set(d, 1e-12f);
  return hn::IfThenElse(hn::Lt(hn::Abs(direction), least), least, direction);
}

HWY_INLINE Rays start(const RayOrigins& origins, std::size_t i, float cosine, float sine) {
  const Places::Floats d;
  const F c = hn::Load(d, &origins.cosine[i]), s = hn::Load(d, &origins.sine[i]);
  const F bc = hn::Set(d, cosine), bs = hn::Set(d, sine), one = hn::Set(d, 1.0f);
  const F dx = away_from_zero(hn::Sub(hn::Mul(c, bc), hn::Mul(s, bs)));
  const F dy = away_from_zero(hn::Add(hn::Mul(s, bc), hn::Mul(c, bs)));
  return {hn::Load(d, &origins.x[i]), hn::Load(d, &origins.y[i]), dx,         dy,
          hn::Div(one, dx),           hn::Div(one, dy),           hn::Zero(d)};
}

// The length at which a ray that comes from `origin` crosses a side of cell `cell`, along one axis: the far
// side if `far` and the near side if not.
HWY_INLINE F crossing(Places::W cell, F origin, F direction, F per_direction, bool far) {
  const Places::Floats d;
  const hn::RebindToSigned<Places::Floats> di;
  const auto upwards = hn::Gt(direction, hn::Zero(d));
  const F one = hn::Set(d, 1.0f);
  const F side = far ? hn::IfThenElseZero(upwards, one) : hn::IfThenZeroElse(upwards, one);
  return hn::Mul(hn::Sub(hn::Add(hn::ConvertTo(d, hn::BitCast(di, cell)), side), origin), per_direction);
}

// One step of every ray, to where it leaves its cell at least; those at their end stay. True if all are.
HWY_INLINE bool advance(const Places& places, const StepPlaneView& plane, F max_range, Rays& rays) {
  const Places::Floats d;
  const hn::RebindToSigned<Places::Floats> di;
  const F column = rays.column(), row = rays.row(), before = rays.length;
  const auto place = hn::BitCast(di, places.of(column, row));
  const auto around = hn::GatherOffset(di, reinterpret_cast<const std::int32_t*>(plane.steps), place);
  const auto code = hn::And(around, hn::Set(di, 0xff));
  const F safe = hn::Mul(hn::Sub(hn::ConvertTo(d, code), hn::Set(d, 1.0f)), hn::Set(d, kCellsPerStep));
  const F exit = hn::Min(crossing(places.column_of(column), rays.x, rays.dx, rays.per_dx, true),
                         crossing(places.row_of(row), rays.y, rays.dy, rays.per_dy, true));
  const F next =
      hn::Add(hn::Max(hn::Add(before, hn::Max(safe, hn::Zero(d))), exit), hn::Set(d, plane.beyond));
  const auto ended = hn::RebindMask(d, hn::Eq(code, hn::Zero(di)));
  rays.length = hn::Min(hn::IfThenElse(ended, before, next), max_range);
  return hn::AllTrue(d, hn::Eq(rays.length, before));
}

// The length at which each ray entered the cell where it ended; `max_range` if that is the border.
HWY_INLINE F length_to_wall(const Places& places, const StepPlaneView& plane, F max_range, const Rays& rays) {
  const Places::Floats d;
  const Places::Words dw;
  const auto column = places.column_of(rays.column()), row = places.row_of(rays.row());
  const F entry = hn::Max(crossing(column, rays.x, rays.dx, rays.per_dx, false),
                          crossing(row, rays.y, rays.dy, rays.per_dy, false));
  const F length = hn::Min(hn::Max(entry, hn::Zero(d)), rays.length);
  const auto none = hn::Zero(dw);
  const auto outside = hn::Or(
      hn::Or(hn::Eq(column, none), hn::Eq(row, none)),
      hn::Or(hn::Eq(column, hn::Set(dw, plane.columns - 1)), hn::Eq(row, hn::Set(dw, plane.rows - 1))));
  const auto unmet = hn::Or(hn::RebindMask(d, outside), hn::Ge(rays.length, max_range));
  return hn::IfThenElse(unmet, max_range, length);
}

// Four vectors of rays at once, so that the memory accesses of one pass while the others compute; those whose
// rays have all ended are left alone.
void march(const StepPlaneView& plane, const RayOrigins& origins, float cosine, float sine, float max_range,
           std::array<float, RayOrigins::kCapacity>& ranges) {
  const Places::Floats d;
  constexpr std::size_t kLanes = hn::MaxLanes(Places::Floats());
  const Places places(plane.columns, plane.rows);
  const F farthest = hn::Set(d, max_range);
  for (std::size_t i = 0; i < RayOrigins::kCapacity; i += 4 * kLanes) {
    Rays rays[4];
    for (std::size_t k = 0; k < 4; ++k) rays[k] = start(origins, i + k * kLanes, cosine, sine);
    bool ended[4] = {};
    do {
      HWY_UNROLL(4)
      for (std::size_t k = 0; k < 4; ++k) {
        if (!ended[k]) ended[k] = advance(places, plane, farthest, rays[k]);
      }
    } while (!(ended[0] && ended[1] && ended[2] && ended[3]));
    for (std::size_t k = 0; k < 4; ++k)
      hn::StoreU(length_to_wall(places, plane, farthest, rays[k]), d, &ranges[i + k * kLanes]);
  }
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn {

HWY_EXPORT(march);

void march(const StepPlaneView& plane, const RayOrigins& origins, float bearing_cosine, float bearing_sine,
           float max_range, std::array<float, RayOrigins::kCapacity>& ranges) {
  HWY_DYNAMIC_DISPATCH(march)(plane, origins, bearing_cosine, bearing_sine, max_range, ranges);
}

}  // namespace cairn
#endif  // HWY_ONCE
