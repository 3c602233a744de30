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
  F x, y, dx, dy, length;

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
  const F bc = hn::Set(d, cosine), bs = hn::Set(d, sine);
  return {hn::Load(d, &origins.x[i]), hn::Load(d, &origins.y[i]),
          away_from_zero(hn::Sub(hn::Mul(c, bc), hn::Mul(s, bs))),
          away_from_zero(hn::Add(hn::Mul(s, bc), hn::Mul(c, bs))), hn::Zero(d)};
}

HWY_INLINE F steps_at(const Places& places, const std::uint8_t* steps, F column, F row) {
  const hn::RebindToSigned<Places::Floats> di;
  const auto place = hn::BitCast(di, places.of(column, row));
  const auto around = hn::GatherOffset(di, reinterpret_cast<const std::int32_t*>(steps), place);
  return hn::ConvertTo(Places::Floats(), hn::And(around, hn::Set(di, 0xff)));
}

// One step of every ray; those at their end stay. True if all are.
HWY_INLINE bool advance(const Places& places, const std::uint8_t* steps, F max_range, Rays& rays) {
  const Places::Floats d;
  const F before = rays.length;
  const F step = hn::Mul(steps_at(places, steps, rays.column(), rays.row()), hn::Set(d, kCellsPerStep));
  rays.length = hn::Min(hn::Add(before, step), max_range);
  return hn::AllTrue(d, hn::Eq(rays.length, before));
}

// The length at which each ray enters the cell that it is in.
HWY_INLINE F entry(const Places& places, const Rays& rays) {
  const Places::Floats d;
  const hn::RebindToSigned<Places::Floats> di;
  const auto edge = [&](Places::W cell, F direction) {
    const F near_side = hn::ConvertTo(d, hn::BitCast(di, cell));
    return hn::Add(near_side, hn::IfThenElseZero(hn::Lt(direction, hn::Zero(d)), hn::Set(d, 1.0f)));
  };
  const F along_x = hn::Div(hn::Sub(edge(places.column_of(rays.column()), rays.dx), rays.x), rays.dx);
  const F along_y = hn::Div(hn::Sub(edge(places.row_of(rays.row()), rays.dy), rays.y), rays.dy);
  return hn::Max(hn::Max(along_x, along_y), hn::Zero(d));
}

// True where the ray is in the border or has gone as far as it may.
HWY_INLINE auto met_nothing(const Places& places, const StepPlaneView& plane, F max_range, const Rays& rays) {
  const Places::Floats d;
  const Places::Words dw;
  const auto column = places.column_of(rays.column()), row = places.row_of(rays.row());
  const auto none = hn::Zero(dw);
  const auto outside = hn::Or(
      hn::Or(hn::Eq(column, none), hn::Eq(row, none)),
      hn::Or(hn::Eq(column, hn::Set(dw, plane.columns - 1)), hn::Eq(row, hn::Set(dw, plane.rows - 1))));
  return hn::Or(hn::RebindMask(d, outside), hn::Ge(rays.length, max_range));
}

// Where each ray entered the walls in which it ended. The last step may have led through the corner of one
// cell of a wall into the next: then the cell before is the one.
HWY_INLINE F length_to_wall(const Places& places, const StepPlaneView& plane, F max_range, Rays rays) {
  constexpr int kMostCellsInAStep = 2;
  const Places::Floats d;
  const auto unmet = met_nothing(places, plane, max_range, rays);
  rays.length = hn::Min(entry(places, rays), rays.length);
  F length = rays.length;
  for (int i = 0; i < kMostCellsInAStep; ++i) {
    rays.length = hn::Max(hn::Sub(length, hn::Set(d, 0.01f)), hn::Zero(d));
    const F step = steps_at(places, plane.steps, rays.column(), rays.row());
    const auto in_wall = hn::Eq(step, hn::Zero(d));
    length = hn::IfThenElse(in_wall, hn::Min(entry(places, rays), length), length);
  }
  return hn::IfThenElse(unmet, max_range, length);
}

// Four vectors of rays at once, so that the memory accesses of one pass while the others compute.
void march(const StepPlaneView& plane, const RayOrigins& origins, float cosine, float sine, float max_range,
           std::array<float, RayOrigins::kCapacity>& ranges) {
  const Places::Floats d;
  constexpr std::size_t kLanes = hn::MaxLanes(Places::Floats());
  const Places places(plane.columns, plane.rows);
  const F farthest = hn::Set(d, max_range);
  for (std::size_t i = 0; i < RayOrigins::kCapacity; i += 4 * kLanes) {
    Rays rays[4];
    for (std::size_t k = 0; k < 4; ++k) rays[k] = start(origins, i + k * kLanes, cosine, sine);
    bool ended[4];
    do {
      HWY_UNROLL(4)
      for (std::size_t k = 0; k < 4; ++k) ended[k] = advance(places, plane.steps, farthest, rays[k]);
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
