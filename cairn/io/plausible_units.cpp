#include "cairn/io/plausible_units.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <vector>

namespace cairn {
namespace {

constexpr double kFarM = 100.0;
constexpr double kFastMps = 10.0;
constexpr std::size_t kMinWindows = 10;
constexpr Duration kWindow = std::chrono::seconds(1);
constexpr double kMovedM = 1e-3;

/// What the check wants to know of one stream.
struct Tally {
  double readings = 0.0;
  double far_readings = 0.0;
  std::optional<Odometry> last;
  std::vector<double> speeds;  ///< metres a second, while moving
  Time since;
  double moved_m = 0.0;

  void add(const std::shared_ptr<const LaserScan>& scan) {
    for (const float range : scan->ranges_m) {
      if (!std::isfinite(range) || range <= 0.0F) continue;
      readings += 1.0;
      far_readings += range > kFarM ? 1.0 : 0.0;
    }
  }
  // Over at least a second each: real logs hold bursts of messages stamped within a millisecond.
  void add(const Odometry& odometry) {
    if (last) moved_m += distance(last->T_odom_base, odometry.T_odom_base);
    if (!last || odometry.stamp < since) since = odometry.stamp;
    last = odometry;
    if (odometry.stamp - since < kWindow) return;
    if (moved_m > kMovedM) speeds.push_back(moved_m / to_seconds(odometry.stamp - since));
    since = odometry.stamp;
    moved_m = 0.0;
  }
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void warn_of_implausible_units(Log& log, const std::string& name) {
  std::vector<Tally> tallies(log.streams.size());
  for (const Event& event : log.events) {
    std::visit([&](const auto& payload) { tallies[event.stream].add(payload); }, event.payload);
  }
  for (std::size_t i = 0; i < tallies.size(); ++i) {
    const std::string where = name + ", stream " + log.streams[i].name;
    const Tally& tally = tallies[i];
    if (tally.far_readings > 0.5 * tally.readings) {
      log.diagnostics.warn("implausible units", where, "most ranges are beyond 100 m; metres are expected");
    }
    if (tally.speeds.size() >= kMinWindows && median(tally.speeds) > kFastMps) {
      log.diagnostics.warn("implausible units", where,
                           "the robot moves faster than 10 m/s; metres and seconds are expected");
    }
  }
}

}  // namespace cairn
