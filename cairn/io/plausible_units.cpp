#include "cairn/io/plausible_units.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

namespace cairn {
namespace {

constexpr double kFarM = 100.0;
constexpr double kFastMps = 10.0;
constexpr std::size_t kMinWindows = 10;
constexpr Duration kWindow = std::chrono::seconds(1);
constexpr double kMovedM = 1e-3;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// What the check wants to know of one stream.
struct Tally {
  double readings = 0.0;
  double far_readings = 0.0;
  SpeedMeter speed;

  void add(const LaserScan& scan) {
    for (const float range : scan.ranges_m) {
      if (!std::isfinite(range) || range <= 0.0F) continue;
      readings += 1.0;
      far_readings += range > kFarM ? 1.0 : 0.0;
    }
  }
  void add(const Odometry& odometry) { speed.add(odometry.stamp, odometry.T_odom_base); }
  template <class Other>
  void add(const Other&) {}  // their units are told by the messages
};

}  // namespace

void SpeedMeter::add(Time stamp, const Pose2& pose) {
  if (last_) moved_m_ += distance(*last_, pose);
  if (!last_ || stamp < since_) since_ = stamp;
  last_ = pose;
  if (stamp - since_ < kWindow) return;
  if (moved_m_ > kMovedM) speeds_mps_.push_back(moved_m_ / to_seconds(stamp - since_));
  since_ = stamp;
  moved_m_ = 0.0;
}

bool SpeedMeter::implausibly_fast() const {
  return speeds_mps_.size() >= kMinWindows && median(speeds_mps_) > kFastMps;
}

bool implausibly_fast(const Trajectory& path) {
  SpeedMeter speed;
  for (const StampedPose& p : path) speed.add(p.stamp, p.pose);
  return speed.implausibly_fast();
}

void warn_of_implausible_units(Log& log, const std::string& name) {
  std::vector<Tally> tallies(log.streams.size());
  for (const Event& event : log.events) {
    visit_payload(event, [&](const auto& measurement) { tallies[event.stream].add(measurement); });
  }
  for (std::size_t i = 0; i < tallies.size(); ++i) {
    const std::string where = name + ", stream " + log.streams[i].name;
    const Tally& tally = tallies[i];
    if (tally.far_readings > 0.5 * tally.readings) {
      log.diagnostics.warn("implausible units", where, "most ranges are beyond 100 m; metres are expected");
    }
    if (tally.speed.implausibly_fast()) {
      log.diagnostics.warn("implausible units", where,
                           "the robot moves faster than 10 m/s; metres and seconds are expected");
    }
  }
}

}  // namespace cairn
