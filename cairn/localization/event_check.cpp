#include "cairn/localization/event_check.hpp"

#include "cairn/sensing/defect.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn {
namespace {

constexpr double kFarthest_m = 1e8;
constexpr double kLargestAngle_rad = 4.0 * 3.15;  // two turns and a rounding
constexpr Duration kFarthestStamp{std::numeric_limits<Duration::rep>::max() / 2};

bool is_far(Time stamp) {
  return stamp.time_since_epoch() > kFarthestStamp || stamp.time_since_epoch() < -kFarthestStamp;
}

const char* stamp_defect(Time of_event, Time of_payload) {
  if (of_event != of_payload) return "has a stamp that is not its event's";
  return is_far(of_event) ? "has a stamp more than 146 years from zero" : nullptr;
}

const char* angle_defect(const LaserScan& scan) {
  if (!std::isfinite(scan.angle_min_rad) || !std::isfinite(scan.angle_increment_rad))
    return "has angles that are not finite";
  if (scan.ranges_m.size() > 1 && scan.angle_increment_rad == 0.0) return "has an angle increment of 0";
  const double sweep_rad = std::abs(scan.angle_increment_rad) * static_cast<double>(scan.ranges_m.size() - 1);
  if (std::abs(scan.angle_min_rad) > kLargestAngle_rad || sweep_rad > kLargestAngle_rad)
    return "sweeps more than two turns";
  return nullptr;
}

const char* payload_defect(Time stamp, const Odometry& odometry) {
  if (const char* what = stamp_defect(stamp, odometry.stamp)) return what;
  const Pose2& pose = odometry.T_odom_base;
  if (!is_finite(pose)) return "has a pose that is not finite";
  if (std::abs(pose.x) > kFarthest_m || std::abs(pose.y) > kFarthest_m)
    return "has a pose more than 100000 km from zero";
  return nullptr;
}

const char* payload_defect(Time stamp, const std::shared_ptr<const LaserScan>& scan) {
  if (!scan) return "is missing";
  if (const char* what = stamp_defect(stamp, scan->stamp)) return what;
  if (scan->ranges_m.empty()) return "has no beams";
  if (const char* what = angle_defect(*scan)) return what;
  // A scan that sees nothing within reach is sound: so is an open place.
  const auto sound = [&](float r) {
    return scan->is_valid_range(r) || r >= scan->range_max_m || r == std::numeric_limits<float>::infinity();
  };
  if (std::none_of(scan->ranges_m.begin(), scan->ranges_m.end(), sound)) return "has no valid range";
  return nullptr;
}

const char* payload_defect(Time stamp, const ImuYawRate& rate) {
  if (const char* what = stamp_defect(stamp, rate.stamp)) return what;
  return defect_of(rate);
}

template <class Measurement>
const char* payload_defect(Time stamp, const std::shared_ptr<const Measurement>& measurement) {
  if (!measurement) return "is missing";
  if (const char* what = stamp_defect(stamp, measurement->stamp)) return what;
  return defect_of(*measurement);
}

}  // namespace

const char* defect(const Event& event) {
  if (is_far(event.arrival)) return "arrived more than 146 years from zero";
  return std::visit([&](const auto& payload) { return payload_defect(event.stamp, payload); }, event.payload);
}

}  // namespace cairn
