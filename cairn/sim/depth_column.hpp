#pragma once

#include "cairn/sim/sensor_options.hpp"
#include "cairn/sim/world_scene.hpp"

#include <span>
#include <vector>

namespace cairn {

/// What the rows of one column of a levelled camera see, in 2.5-D: a column looks along one bearing, so that
/// one horizontal ray tells all walls that it can see, and each of them covers the rows between its lower and
/// its upper edge. Depths are along the optical axis, metres.
class DepthColumn {
 public:
  /// @param focal_px  of the camera, whose middle row looks level
  DepthColumn(const WorldDepthCameraOptions& options, double focal_px, double ceiling_m);

  /// Depths of all rows, top down, along one horizontal ray; kNothing beyond the last surface met.
  /// @param foreshortening  depth along the optical axis for each metre along the ray
  /// @param mesh_draw       uniform number that decides at meshes
  std::span<const float> cast(const WorldScene& scene, const Point2& origin, const Point2& direction,
                              double foreshortening, double mesh_draw);

  static constexpr float kNothing = 1e6F;

 private:
  struct Box;
  void paint_upright(double depth_m, const HeightSpan& span);
  void paint_level(double height_m, double near_m, double far_m);
  void paint_lids(const HeightSpan& span, double near_m, double far_m);
  bool fills_view(double depth_m, const HeightSpan& span) const;
  double row_of(double height_m, double depth_m) const;

  WorldDepthCameraOptions options_;
  double focal_px_;
  double middle_row_;
  double ceiling_m_;
  std::vector<float> empty_;  // the floor and the ceiling
  std::vector<float> depths_;
};

}  // namespace cairn
