// Beside a robot's drivers: what they say becomes events, and what the localizer says is what navigation
// needs. A map of your own is read by cairn::read_map_set("map.yaml", diagnostics) (cairn/io/map_reader.hpp),
// parameters by cairn::read_configuration (cairn/io/configuration.hpp).
#include "cairn/localization/monte_carlo_localizer.hpp"
#include "cairn/sim/office_recording.hpp"

#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

namespace {

class Localization {
 public:
  // The table of streams: events name them by their index.
  Localization(const cairn::MapLibrary& map, const cairn::Start& start, const cairn::Pose2& T_base_laser)
      : localizer_({},
                   {{"wheels", cairn::StreamKind::kOdometry, "odom", {}},
                    {"laser", cairn::StreamKind::kLaserScan, "laser", T_base_laser}},
                   map, start, /*seed=*/1, std::make_shared<const cairn::Executor>()) {}

  // Pose of the base in the frame of the odometry. `now`: when it arrived; what comes late is put at its
  // stamp.
  void on_wheels(cairn::Time stamp, cairn::Time now, const cairn::Pose2& T_odom_base) {
    localizer_.process({stamp, now, kWheels, cairn::Odometry{stamp, T_odom_base}});
  }

  // A scan takes milliseconds (docs/models.md); one after which a lost robot is looked for on the whole map
  // much longer: call it from a thread of its own.
  void on_scan(cairn::LaserScan scan, cairn::Time now) {
    const cairn::Time stamp = scan.stamp;
    localizer_.process({stamp, now, kLaser, std::make_shared<const cairn::LaserScan>(std::move(scan))});
  }

  // What to publish as the transform from map to odom, and whether to rely on it.
  bool tell(cairn::Pose2& T_map_odom) const {
    const auto estimate = localizer_.estimate();
    if (!estimate) return false;
    T_map_odom = estimate->T_map_odom;
    const cairn::TrackingState state = estimate->judgement.state;
    return state == cairn::TrackingState::kTracking || state == cairn::TrackingState::kCrowded;
  }

 private:
  static constexpr cairn::StreamId kWheels = 0, kLaser = 1;
  cairn::MonteCarloLocalizer localizer_;
};

}  // namespace

int main() {
  // In place of drivers: half a minute of a simulated robot in an office.
  cairn::OfficeRecordingOptions drive;
  drive.duration = cairn::duration_from_seconds(30.0);
  const cairn::OfficeRecording robot = cairn::record_office(drive, 1);
  cairn::Pose2 T_base_laser;
  for (const cairn::StreamInfo& stream : robot.streams)
    if (stream.kind == cairn::StreamKind::kLaserScan) T_base_laser = stream.T_base_sensor.value();

  Localization localization(robot.map, {robot.truth.front().pose}, T_base_laser);
  cairn::Pose2 T_odom_base, T_map_odom;
  bool reliable = false;
  for (const cairn::Event& event : robot.events) {
    if (const auto* wheels = std::get_if<cairn::Odometry>(&event.payload)) {
      T_odom_base = wheels->T_odom_base;
      localization.on_wheels(event.stamp, event.arrival, T_odom_base);
    } else if (const auto* scan = std::get_if<std::shared_ptr<const cairn::LaserScan>>(&event.payload)) {
      localization.on_scan(**scan, event.arrival);
    }
    reliable = localization.tell(T_map_odom);
  }
  const cairn::Pose2 T_map_base = T_map_odom * T_odom_base;
  const double error_m = cairn::distance(T_map_base, robot.truth.back().pose);
  std::printf("%s: x %.3f m, y %.3f m; %.1f cm off the truth\n", reliable ? "reliable" : "not reliable",
              T_map_base.x, T_map_base.y, 100.0 * error_m);
  return reliable && error_m < 0.2 ? 0 : 1;
}
