#include "cairn/models/sensor/beam_skipping.hpp"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace cairn {
namespace {

// Per point (robot's base frame): from how many of the poses it lies near a wall.
std::vector<std::size_t> times_near_walls(const DistanceField& field, std::span<const Point2> points,
                                          std::span<const Pose2> T_map_base, double within_m) {
  const GridGeometry& grid = field.geometry();
  const Pose2 T_grid_map = inverse(grid.T_map_grid);
  const double per_m = 1.0 / grid.resolution_m;
  std::vector<std::size_t> times(points.size());
  for (const Pose2& state : T_map_base) {
    const Pose2 pose = T_grid_map * state;
    const double c = std::cos(pose.theta), s = std::sin(pose.theta);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Point2& p = points[k];
      const Point2 cell{(pose.x + c * p.x - s * p.y) * per_m, (pose.y + s * p.x + c * p.y) * per_m};
      if (!(cell.x >= 0.0 && cell.x < grid.width && cell.y >= 0.0 && cell.y < grid.height)) continue;
      const std::size_t index = grid.index(static_cast<int>(cell.x), static_cast<int>(cell.y));
      times[k] += field.distance_m(index) <= within_m ? 1 : 0;
    }
  }
  return times;
}

}  // namespace

void BeamSkippingOptions::visit(OptionVisitor& v) {
  v.flag({"use", "leave out beams that fit the map nowhere in the belief", {"do_beamskip"}}, use);
  v.number(
      {"distance_m", "a beam that ends within this of a wall fits the map, metres", {"beam_skip_distance"}},
      distance_m, {0.01, 100.0});
  v.number({"threshold",
            "beams that fit in this share of the belief or less are left out",
            {"beam_skip_threshold"}},
           threshold, {0.0, 1.0});
  v.number({"error_threshold",
            "if this share of the beams would be left out, none is",
            {"beam_skip_error_threshold"}},
           error_threshold, {0.0, 1.0});
}

BeamSkipping::BeamSkipping(std::shared_ptr<const DistanceField> field, const Pose2& T_base_sensor,
                           const BeamLimits& limits, const BeamSkippingOptions& options)
    : field_(std::move(field)), T_base_sensor_(T_base_sensor), limits_(limits), options_(options) {}

LaserScan BeamSkipping::expected_part(const LaserScan& scan, std::span<const Pose2> belief) const {
  LaserScan expected = scan;
  if (belief.empty()) return expected;
  const std::vector<std::size_t> beams = select_beams(scan, limits_, 0);
  const std::vector<Point2> points = select_end_points(scan, T_base_sensor_, limits_, 0);
  const auto times = times_near_walls(*field_, points, belief, options_.distance_m);
  const double few = options_.threshold * static_cast<double>(belief.size());
  std::size_t skipped = 0;
  for (std::size_t k = 0; k < beams.size(); ++k) {
    if (static_cast<double>(times[k]) > few) continue;
    expected.ranges_m[beams[k]] = std::numeric_limits<float>::quiet_NaN();
    ++skipped;
  }
  const double most = options_.error_threshold * static_cast<double>(beams.size());
  return static_cast<double>(skipped) < most ? expected : scan;
}

}  // namespace cairn
