#include "cairn/models/sensor/beam_selection.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

std::vector<std::size_t> valid_beams(const LaserScan& scan, const BeamLimits& limits) {
  std::vector<std::size_t> valid;
  valid.reserve(scan.ranges_m.size());
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const float range = scan.ranges_m[i];
    if (scan.is_valid_range(range) && range >= limits.min_range_m && range < limits.max_range_m)
      valid.push_back(i);
  }
  return valid;
}

}  // namespace

std::vector<Point2> select_end_points(const LaserScan& scan, const Pose2& T_base_sensor,
                                      const BeamLimits& limits, int max_beams) {
  const std::vector<std::size_t> valid = valid_beams(scan, limits);
  const std::size_t wanted = max_beams > 0 ? static_cast<std::size_t>(max_beams) : valid.size();
  const std::size_t count = std::min(wanted, valid.size());
  std::vector<Point2> points;
  points.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i =
        valid[(2 * k + 1) * valid.size() / (2 * count)];  // the middle of the k-th equal share
    const double angle = scan.angle_min_rad + static_cast<double>(i) * scan.angle_increment_rad;
    const double range = scan.ranges_m[i];
    points.push_back(T_base_sensor * Point2{range * std::cos(angle), range * std::sin(angle)});
  }
  return points;
}

}  // namespace cairn
