#include "apps/cairn/map_building.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>

namespace cairn::app {
namespace {

std::vector<Point2> end_points(const LaserScan& scan) {
  std::vector<Point2> points;
  points.reserve(scan.ranges_m.size());
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double range = scan.ranges_m[i];
    if (!scan.is_valid_range(scan.ranges_m[i])) continue;
    const double angle = scan.angle_min_rad + static_cast<double>(i) * scan.angle_increment_rad;
    points.push_back({range * std::cos(angle), range * std::sin(angle)});
  }
  return points;
}

struct Counts {
  std::size_t used = 0, without_pose = 0, without_return = 0;
};

Counts add_scans(const Log& log, const Trajectory& trajectory, const PosedScanOptions& options,
                 GridBuilder& builder, const std::function<void(double)>& progress) {
  const PosedScans posed = pose_scans(log, trajectory, options);
  Counts counts{.without_pose = posed.without_pose};
  for (std::size_t i = 0; i < posed.scans.size(); ++i) {
    progress(static_cast<double>(i) / static_cast<double>(posed.scans.size()));
    const auto points = end_points(*posed.scans[i].scan);
    if (points.empty()) ++counts.without_return;
    if (points.empty()) continue;
    builder.add(posed.scans[i].T_map_sensor, points);
    ++counts.used;
  }
  progress(1.0);
  return counts;
}

}  // namespace

std::vector<Time> stamps_of(const Log& log, StreamId stream) {
  std::vector<Time> stamps;
  for (const Event& event : log.events) {
    if (event.stream == stream) stamps.push_back(event.stamp);
  }
  return stamps;
}

BuiltMap build_map(const Log& log, const Trajectory& trajectory, const MapBuildingOptions& options,
                   const std::function<void(double)>& progress) {
  GridBuilder builder(options.grid);
  const Counts counts = add_scans(log, trajectory, options.scans, builder, progress);
  if (counts.used == 0) {
    throw InputError("map", "no scan lies inside the trajectory",
                     "check that log and trajectory are of the same run and clock, and --max-gap-s");
  }
  return {builder.build(), counts.used, counts.without_pose, counts.without_return};
}

NdtMap build_ndt(const Log& log, const Trajectory& trajectory, const MapBuildingOptions& options,
                 const NdtMapOptions& ndt) {
  std::vector<NdtScan> scans;
  for (const PosedScan& posed : pose_scans(log, trajectory, options.scans).scans) {
    std::vector<Point2> points = end_points(*posed.scan);
    std::erase_if(points, [&](const Point2& p) { return std::hypot(p.x, p.y) > options.grid.max_range_m; });
    scans.push_back({posed.T_map_sensor, std::move(points)});
  }
  return ndt_from_scans(scans, ndt);
}

}  // namespace cairn::app
