#include "apps/cairn/scan_pairs.hpp"

#include <cmath>
#include <memory>
#include <optional>

namespace cairn::app {
namespace {

constexpr std::size_t kMostPairs = 3000;
constexpr int kBeams = 60;  // of a scan
constexpr double kLongest_s = 1.5;
constexpr double kSameSurface_m = 0.2;
constexpr double kStill_m = 5e-4, kStill_rad = 2e-4;

// The range of the surface between two neighbouring beams; nullopt where there is none.
std::optional<double> surface_range(const LaserScan& scan, double bearing_rad) {
  const double at = (bearing_rad - scan.angle_min_rad) / scan.angle_increment_rad;
  if (at < 0.0 || at + 1.0 >= static_cast<double>(scan.ranges_m.size())) return std::nullopt;
  const auto below = static_cast<std::size_t>(at);
  const float a = scan.ranges_m[below], b = scan.ranges_m[below + 1];
  if (!scan.is_valid_range(a) || !scan.is_valid_range(b) || std::abs(a - b) > kSameSurface_m)
    return std::nullopt;
  return std::lerp(static_cast<double>(a), static_cast<double>(b), at - static_cast<double>(below));
}

double bearing_of(const LaserScan& scan, std::size_t beam) {
  return scan.angle_min_rad + static_cast<double>(beam) * scan.angle_increment_rad;
}

void add_pair(const LaserScan& before, const LaserScan& scan, const Pose2& T_before_scan, ScanPairs& pairs) {
  const std::size_t step = scan.ranges_m.size() / kBeams + 1;
  const bool is_still =
      std::hypot(T_before_scan.x, T_before_scan.y) < kStill_m && std::abs(T_before_scan.theta) < kStill_rad;
  for (std::size_t i = 0; i < scan.ranges_m.size(); i += step) {
    const double range = scan.ranges_m[i];
    if (!scan.is_valid_range(scan.ranges_m[i])) continue;
    if (is_still) {
      if (i < before.ranges_m.size() && before.is_valid_range(before.ranges_m[i]))
        pairs.standing.push_back(range - before.ranges_m[i]);
      continue;
    }
    const double bearing = bearing_of(scan, i);
    const Point2 p = T_before_scan * Point2{range * std::cos(bearing), range * std::sin(bearing)};
    if (const auto expected = surface_range(before, std::atan2(p.y, p.x)))
      pairs.moving.push_back(std::hypot(p.x, p.y) - *expected);
  }
}

}  // namespace

ScanPairs pair_scans(const Log& log, StreamId laser, const Trajectory& odometry, const Pose2& T_base_laser) {
  std::vector<std::shared_ptr<const LaserScan>> scans;
  for (const Event& event : log.events) {
    if (event.stream == laser) scans.push_back(std::get<std::shared_ptr<const LaserScan>>(event.payload));
  }
  ScanPairs pairs;
  const std::size_t step = scans.size() / kMostPairs + 1;
  for (std::size_t i = 1; i < scans.size(); i += step) {
    const LaserScan& before = *scans[i - 1];
    const LaserScan& scan = *scans[i];
    const double gap_s = to_seconds(scan.stamp - before.stamp);
    const auto from = pose_at(odometry, before.stamp), to = pose_at(odometry, scan.stamp);
    if (!from || !to || gap_s <= 0.0 || gap_s > kLongest_s) continue;
    add_pair(before, scan, between(*from * T_base_laser, *to * T_base_laser), pairs);
  }
  return pairs;
}

}  // namespace cairn::app
