#include "cairn/sim/sensor_check.hpp"

#include "cairn/core/errors.hpp"

#include <cmath>
#include <map>

namespace cairn {
namespace {

constexpr std::size_t kMostLasers = 9;     // a CARMEN log tells no more apart
constexpr std::size_t kMostSensors = 255;  // and the odometry: the streams of a recording
constexpr double kMostReadings = 2e9;      // 8 GB of ranges
constexpr double kMostPixels = 2e10;       // 40 GB of depths
constexpr double kShortestBetweenBursts_s = 0.01;
constexpr double kUsualDuration_s = 600.0;

class SensorCheck {
 public:
  explicit SensorCheck(const WorldOptions& options) : options_(options) {}

  template <class Sensor>
  void check_all(const char* table, const std::vector<Sensor>& sensors) {
    for (const Sensor& sensor : sensors) {
      const std::string key = std::string(table) + "." + sensor.name;
      check_name(key, sensor.name);
      const Pose2 mount = parse_world_pose(key + ".mount", sensor.mount);
      if (std::hypot(mount.x, mount.y) > options_.robot.radius_m) {
        throw ConfigurationError(key + ".mount", "sticks out of the robot, so that it would run into walls",
                                 "mount it within robot.radius_m");
      }
      check_bursts(key + ".stall_every_s", sensor.timing.stall_every_s);
      check_bursts(key + ".outage_every_s", sensor.timing.outage_every_s);
      check(key, sensor);
    }
  }

  std::size_t sensors() const { return names_.size(); }

 private:
  void check_name(const std::string& key, const std::string& name) {
    const auto [entry, is_new] = names_.emplace(name, key);
    if (!is_new) {
      throw ConfigurationError(key, "has the name of " + entry->second + ": their streams would be one",
                               "rename one of them");
    }
    if (name == "odom") throw ConfigurationError(key, "has the name of the odometry", "rename it");
  }

  static void check_bursts(const std::string& key, double every_s) {
    if (every_s == 0.0 || every_s >= kShortestBetweenBursts_s) return;
    throw ConfigurationError(key, "is shorter than 0.01 s", "give 0 for none, or a longer time");
  }

  static void check_limits(const std::string& key, double min_m, double max_m) {
    if (max_m > min_m) return;
    throw ConfigurationError(key + ".range_max_m", "is not above range_min_m", "correct one of them");
  }

  void check_amount(const std::string& key, const WorldTimingOptions& timing, double readings,
                    double most) const {
    const double duration_s = options_.robot.duration_s > 0.0 ? options_.robot.duration_s : kUsualDuration_s;
    if (timing.rate_hz * duration_s * readings <= most) return;
    throw ConfigurationError(key + ".rate_hz", "makes more readings than fit into memory",
                             "use a smaller rate, fewer readings or a shorter robot.duration_s");
  }

  static void check_partners(const std::string& key, bool any, const char* table) {
    if (any) return;
    throw ConfigurationError(key, "has nothing to find", std::string("name some ") + table);
  }

  void check(const std::string& key, const WorldLaserOptions& o) const {
    check_limits(key, o.range_min_m, o.range_max_m);
    check_amount(key, o.timing, o.beams, kMostReadings);
  }
  void check(const std::string& key, const WorldSonarOptions& o) const {
    check_limits(key, o.range_min_m, o.range_max_m);
    check_amount(key, o.timing, o.transducers, kMostReadings);
  }
  void check(const std::string& key, const WorldDepthCameraOptions& o) const {
    check_limits(key, o.range_min_m, o.range_max_m);
    check_amount(key, o.timing, double{1} * o.width * o.height, kMostPixels);
    if (o.height_m < options_.ceiling.height_m) return;
    throw ConfigurationError(key + ".height_m", "is not below ceiling.height_m", "correct one of them");
  }
  void check(const std::string& key, const WorldWifiOptions& o) const {
    check_partners(key, !options_.access_points.empty(), "access_points");
    check_amount(key, o.timing, static_cast<double>(options_.access_points.size()), kMostReadings);
  }
  void check(const std::string& key, const WorldBeaconRadioOptions& o) const {
    check_partners(key, !options_.beacons.empty(), "beacons");
    check_amount(key, o.timing, static_cast<double>(options_.beacons.size()), kMostReadings);
  }
  void check(const std::string& key, const WorldLandmarkDetectorOptions& o) const {
    check_partners(key, !options_.landmarks.empty(), "landmarks");
    check_amount(key, o.timing, static_cast<double>(options_.landmarks.size()), kMostReadings);
  }
  void check(const std::string& key, const WorldCeilingCameraOptions& o) const {
    check_amount(key, o.timing, double{1} * o.pixels * o.pixels, kMostPixels);
  }
  void check(const std::string& key, const WorldGyroscopeOptions& o) const {
    check_amount(key, o.timing, 1.0, kMostReadings);
  }

  const WorldOptions& options_;
  std::map<std::string, std::string> names_;  // of the sensors, and their keys
};

template <class Entry>
void check_places(const char* table, const std::vector<Entry>& entries) {
  for (const Entry& entry : entries) parse_point(std::string(table) + "." + entry.name + ".at", entry.at);
}

}  // namespace

void check_sensors(const WorldOptions& options) {
  check_places("access_points", options.access_points);
  check_places("beacons", options.beacons);
  check_places("landmarks", options.landmarks);
  SensorCheck check(options);
  check.check_all("lasers", options.lasers);
  check.check_all("sonars", options.sonars);
  check.check_all("depth_cameras", options.depth_cameras);
  check.check_all("wifi_radios", options.wifi_radios);
  check.check_all("beacon_radios", options.beacon_radios);
  check.check_all("landmark_detectors", options.landmark_detectors);
  check.check_all("ceiling_cameras", options.ceiling_cameras);
  check.check_all("gyroscopes", options.gyroscopes);
  if (check.sensors() == 0)
    throw ConfigurationError("lasers", "is missing: the robot would be blind",
                             "add a laser or another sensor");
  if (options.lasers.size() > kMostLasers)
    throw ConfigurationError("lasers", "are more than nine", "remove some");
  if (check.sensors() > kMostSensors)
    throw ConfigurationError("lasers", "and all other sensors are more than 255", "remove some");
}

}  // namespace cairn
