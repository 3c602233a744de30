#include "cairn/sim/depth_column.hpp"

#include "cairn/sim/world_laser.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cairn {
namespace {

constexpr int kMostMirrors = 4;
constexpr std::size_t kMostBoxes = 16;  // that one ray is within or behind

// Boxes whose near side the ray has met, but not yet the far one.
class OpenBoxes {
 public:
  // The range of the near side, if this is the far one.
  std::optional<double> meet(std::int32_t box, double range_m) {
    for (std::size_t i = 0; i < count_; ++i) {
      if (boxes_[i].box != box) continue;
      const double near_m = boxes_[i].near_m;
      boxes_[i] = boxes_[--count_];
      return near_m;
    }
    if (count_ < kMostBoxes) boxes_[count_++] = {box, range_m};
    return std::nullopt;
  }

 private:
  struct Open {
    std::int32_t box;
    double near_m;
  };
  std::array<Open, kMostBoxes> boxes_{};
  std::size_t count_ = 0;
};

}  // namespace

DepthColumn::DepthColumn(const WorldDepthCameraOptions& options, double focal_px, double ceiling_m)
    : options_(options),
      focal_px_(focal_px),
      middle_row_(0.5 * (options.height - 1)),
      ceiling_m_(ceiling_m),
      empty_(static_cast<std::size_t>(options.height), kNothing) {
  depths_ = empty_;
  paint_level(0.0, 0.0, kNothing);
  paint_level(ceiling_m, 0.0, kNothing);
  empty_ = depths_;
}

double DepthColumn::row_of(double height_m, double depth_m) const {
  return middle_row_ + focal_px_ * (options_.height_m - height_m) / depth_m;
}

void DepthColumn::paint_upright(double depth_m, const HeightSpan& span) {
  const double rows = static_cast<double>(depths_.size());
  const double first = std::clamp(std::ceil(row_of(span.top_m, depth_m)), 0.0, rows);
  const double end = std::clamp(std::floor(row_of(span.bottom_m, depth_m)) + 1.0, first, rows);
  const auto depth = static_cast<float>(depth_m);
  for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(end); ++i)
    depths_[i] = std::min(depths_[i], depth);
}

// A level surface between two depths: the floor, the ceiling, the upper or lower side of a box.
void DepthColumn::paint_level(double height_m, double near_m, double far_m) {
  const double above_m = options_.height_m - height_m;  // negative: the surface is over the camera
  for (std::size_t i = 0; i < depths_.size(); ++i) {
    const double depth = focal_px_ * above_m / (static_cast<double>(i) - middle_row_);
    if (depth > 0.0 && depth >= near_m && depth <= far_m)
      depths_[i] = std::min(depths_[i], static_cast<float>(depth));
  }
}

void DepthColumn::paint_lids(const HeightSpan& span, double near_m, double far_m) {
  if (span.top_m < options_.height_m) paint_level(span.top_m, near_m, far_m);
  if (span.bottom_m > options_.height_m) paint_level(span.bottom_m, near_m, far_m);
}

// Nothing behind can be seen any more.
bool DepthColumn::fills_view(double depth_m, const HeightSpan& span) const {
  const bool above = span.top_m >= ceiling_m_ || row_of(span.top_m, depth_m) <= 0.0;
  const bool below =
      span.bottom_m <= 0.0 || row_of(span.bottom_m, depth_m) >= static_cast<double>(depths_.size()) - 1.0;
  return above && below;
}

std::span<const float> DepthColumn::cast(const WorldScene& scene, const Point2& origin,
                                         const Point2& direction, double foreshortening, double mesh_draw) {
  std::copy(empty_.begin(), empty_.end(), depths_.begin());
  const double farthest_m = options_.range_max_m / foreshortening;
  Point2 at = origin, along = direction;
  double travelled = 0.0;
  int mirrors = 0;
  OpenBoxes boxes;
  for (int surface = 0; surface < WorldScene::kMostSurfaces && travelled < farthest_m; ++surface) {
    const auto met = scene.nearest(at, along, farthest_m - travelled);
    if (!met) break;
    travelled += met->range_m;
    const double depth = travelled * foreshortening;
    if (met->span.box != HeightSpan::kNoBox) {
      if (const auto near_m = boxes.meet(met->span.box, travelled))
        paint_lids(met->span, *near_m * foreshortening, depth);
    }
    const bool is_mirror = met->material == Material::kMirror && met->span.contains(options_.height_m);
    if (returns_light(*met, met->incidence_rad(along), mesh_draw)) {
      paint_upright(depth, met->span);
      if (fills_view(depth, met->span)) break;
    }
    if (is_mirror && ++mirrors > kMostMirrors) break;
    at = {at.x + met->range_m * along.x, at.y + met->range_m * along.y};
    if (is_mirror) along = reflected(along, met->along);
    at = {at.x + WorldScene::kPassed_m * along.x, at.y + WorldScene::kPassed_m * along.y};
    travelled += WorldScene::kPassed_m;
  }
  return depths_;
}

}  // namespace cairn
