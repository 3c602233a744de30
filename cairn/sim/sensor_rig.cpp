#include "cairn/sim/sensor_rig.hpp"

#include "cairn/sim/world_ceiling.hpp"
#include "cairn/sim/world_depth_camera.hpp"
#include "cairn/sim/world_gyroscope.hpp"
#include "cairn/sim/world_landmarks.hpp"
#include "cairn/sim/world_laser.hpp"
#include "cairn/sim/world_radio.hpp"
#include "cairn/sim/world_sonar.hpp"

#include <cmath>
#include <memory>

namespace cairn {
namespace {

class Rig {
 public:
  /// @param measure  (view, options) -> measurement
  template <class Options, class Measure>
  void add(const char* table, StreamKind kind, const Options& options, const Measure& measure) {
    using Measurement = std::invoke_result_t<Measure, const SensorView&, const Options&>;
    const Pose2 T_base_sensor =
        parse_world_pose(std::string(table) + "." + options.name + ".mount", options.mount);
    sensors_.push_back({{options.name, kind, options.name, T_base_sensor},
                        options.timing,
                        [options, measure](const SensorView& view) -> Event::Payload {
                          if constexpr (std::is_same_v<Measurement, ImuYawRate>) {
                            return measure(view, options);
                          } else {
                            return std::make_shared<const Measurement>(measure(view, options));
                          }
                        }});
  }

  template <class Options, class Measure>
  void add_all(const char* table, StreamKind kind, const std::vector<Options>& all, const Measure& measure) {
    for (const Options& options : all) add(table, kind, options, measure);
  }

  std::vector<WorldSensor> take() { return std::move(sensors_); }
  std::size_t size() const { return sensors_.size(); }

 private:
  std::vector<WorldSensor> sensors_;
};

LaserScan measure_laser(const SensorView& view, const WorldLaserOptions& options) {
  const SimulatedDrive& drive = view.drive;
  LaserScan scan = simulate_world_scan(drive.world, drive.walls, drive.people, drive.truth, options,
                                       view.measured, view.sensor, view.index, drive.seed);
  scan.stamp = view.stamp;
  return scan;
}

void add_radios(const WorldOptions& o, Rig& rig) {
  using Transmitters = std::shared_ptr<const std::vector<Transmitter>>;
  const auto make = [&o](const char* table, const auto& options) -> Transmitters {
    return std::make_shared<const std::vector<Transmitter>>(make_transmitters(table, options, o.radio));
  };
  const Transmitters access_points = make("access_points", o.access_points),
                     beacons = make("beacons", o.beacons);
  rig.add_all("wifi_radios", StreamKind::kWifiScan, o.wifi_radios,
              [access_points](const SensorView& view, const WorldWifiOptions& options) {
                return simulate_wifi(view, options, *access_points);
              });
  rig.add_all("beacon_radios", StreamKind::kBeaconRanges, o.beacon_radios,
              [beacons](const SensorView& view, const WorldBeaconRadioOptions& options) {
                return simulate_beacons(view, options, *beacons);
              });
}

void add_gyroscopes(const WorldOptions& o, Time end, std::uint64_t seed, Rig& rig) {
  for (const WorldGyroscopeOptions& options : o.gyroscopes) {
    const auto readings = static_cast<std::size_t>(std::ceil(to_seconds(end) * options.timing.rate_hz)) + 2;
    const auto errors =
        std::make_shared<const GyroscopeErrors>(draw_gyroscope_errors(options, rig.size(), readings, seed));
    rig.add("gyroscopes", StreamKind::kImuYawRate, options,
            [errors](const SensorView& view, const WorldGyroscopeOptions& own) {
              return simulate_gyroscope(view, own, *errors);
            });
  }
}

}  // namespace

std::vector<WorldSensor> make_sensors(const World& world, Time end, std::uint64_t seed) {
  const WorldOptions& o = world.options;
  Rig rig;
  rig.add_all("lasers", StreamKind::kLaserScan, o.lasers, measure_laser);
  rig.add_all("sonars", StreamKind::kSonarScan, o.sonars, simulate_sonar);
  rig.add_all("depth_cameras", StreamKind::kDepthImage, o.depth_cameras, simulate_depth_image);
  add_radios(o, rig);
  const auto landmarks = std::make_shared<const std::vector<PlacedLandmark>>(make_landmarks(o.landmarks));
  rig.add_all("landmark_detectors", StreamKind::kLandmarkDetections, o.landmark_detectors,
              [landmarks](const SensorView& view, const WorldLandmarkDetectorOptions& options) {
                return simulate_landmarks(view, options, *landmarks);
              });
  rig.add_all("ceiling_cameras", StreamKind::kCeilingPatch, o.ceiling_cameras, simulate_ceiling);
  add_gyroscopes(o, end, seed, rig);
  return rig.take();
}

}  // namespace cairn
