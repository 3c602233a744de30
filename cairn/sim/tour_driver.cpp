#include "cairn/sim/tour_driver.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kReached_m = 0.1;
constexpr double kTurnOnTheSpot_rad = 0.4;  // a waypoint farther aside is first turned to
constexpr double kTurnGain = 2.5;           // turn rate per heading error, 1/s
constexpr Duration kLongest = std::chrono::hours(24);

struct Speeds {
  double forward = 0.0;  // m/s
  double turn = 0.0;     // rad/s
};

double approach(double value, double wanted, double largest_change) {
  return value + std::clamp(wanted - value, -largest_change, largest_change);
}

Speeds wanted_speeds(const Pose2& pose, const Point2& target, const DriveLimits& limits) {
  const double distance_m = std::hypot(target.x - pose.x, target.y - pose.y);
  const double aside = angle_difference(std::atan2(target.y - pose.y, target.x - pose.x), pose.theta);
  const double turn = std::clamp(kTurnGain * aside, -limits.turn_rate_radps, limits.turn_rate_radps);
  if (std::abs(aside) > kTurnOnTheSpot_rad) return {0.0, turn};
  // Half of the allowed deceleration: the other half is for what the controller misjudges.
  const double braking = std::sqrt(limits.acceleration_mps2 * distance_m);
  return {std::min(limits.speed_mps, braking) * std::cos(aside), turn};
}

void check(const std::vector<Point2>& waypoints, const DriveLimits& limits) {
  if (waypoints.empty()) throw ConfigurationError("tour", "has no waypoints", "add some");
  const bool positive = limits.speed_mps > 0.0 && limits.turn_rate_radps > 0.0 &&
                        limits.acceleration_mps2 > 0.0 && limits.turn_acceleration_radps2 > 0.0 &&
                        limits.step > Duration::zero();
  if (!positive) throw ConfigurationError("drive limits", "must all be positive", "correct them");
}

}  // namespace

Trajectory drive_tour(const Pose2& start, const std::vector<Point2>& waypoints, const DriveLimits& limits,
                      Duration duration) {
  check(waypoints, limits);
  const double dt = to_seconds(limits.step);
  Trajectory path{{Time{}, start}};
  Speeds speeds;
  std::size_t next = 0;
  while (duration == Duration::zero() || path.back().stamp.time_since_epoch() < duration) {
    const auto [stamp, pose] = path.back();
    if (stamp.time_since_epoch() > kLongest)
      throw ConfigurationError("tour", "takes over a day", "shorten it");
    if (std::hypot(waypoints[next].x - pose.x, waypoints[next].y - pose.y) < kReached_m) {
      next = (next + 1) % waypoints.size();
      if (next == 0 && duration == Duration::zero()) break;
    }
    const Speeds wanted = wanted_speeds(pose, waypoints[next], limits);
    speeds.forward = approach(speeds.forward, wanted.forward, limits.acceleration_mps2 * dt);
    speeds.turn = approach(speeds.turn, wanted.turn, limits.turn_acceleration_radps2 * dt);
    path.push_back({stamp + limits.step, pose * exp({speeds.forward * dt, 0.0, speeds.turn * dt})});
  }
  return path;
}

}  // namespace cairn
