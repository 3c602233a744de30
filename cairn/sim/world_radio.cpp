#include "cairn/sim/world_radio.hpp"

#include <cmath>

namespace cairn {
namespace {

constexpr std::uint64_t kBeaconFields = std::uint64_t{1} << 32;  // behind those of all access points

// What decides about one transmitter in one measurement.
constexpr std::uint16_t kNoise = 0, kFate = 1, kWrong = 2, kObstructed = 3, kObstructedDelay = 4;
constexpr std::uint16_t kDelay = 5;  // and the following: one for each wall

double level_at(const SensorView& view, const WorldScene& scene, const Transmitter& transmitter,
                const Point2& receiver) {
  const WorldRadioOptions& radio = view.drive.world.options.radio;
  return received_level_dbm(scene, radio, transmitter.at, transmitter.power_dbm, receiver) +
         transmitter.shadowing.at(receiver);
}

// The sum of as many exponential numbers of that mean as there are walls.
double delay_m(int walls, double mean_m, const RandomStream& random, std::uint32_t item) {
  double delay = 0.0;
  for (int wall = 0; wall < walls; ++wall)
    delay -= mean_m * std::log(random.uniform(item, static_cast<std::uint16_t>(kDelay + wall)));
  return delay;
}

// What stands between and the world does not hold.
double obstruction_m(const WorldTransmitterOptions& beacon, const RandomStream& random, std::uint32_t item) {
  if (random.uniform(item, kObstructed) >= beacon.obstructed_share) return 0.0;
  return -beacon.obstructed_mean_m * std::log(random.uniform(item, kObstructedDelay));
}

Point2 receiver_of(const SensorView& view, const std::string& mount) {
  const Pose2 pose = view.base_in_map() * parse_world_pose("mount", mount);
  return {pose.x, pose.y};
}

}  // namespace

std::vector<Transmitter> make_transmitters(const std::string& table,
                                           const std::vector<WorldTransmitterOptions>& options,
                                           const WorldRadioOptions& radio) {
  const std::uint64_t first = table == "beacons" ? kBeaconFields : 0;
  std::vector<Transmitter> transmitters;
  transmitters.reserve(options.size());
  for (const WorldTransmitterOptions& o : options) {
    transmitters.push_back(
        {o.name, parse_point(table + "." + o.name + ".at", o.at), o.power_dbm,
         ShadowingField(radio.sigma_shadowing_db, radio.shadowing_distance_m,
                        static_cast<std::uint64_t>(radio.pattern), first + transmitters.size()),
         o});
  }
  return transmitters;
}

WifiScan simulate_wifi(const SensorView& view, const WorldWifiOptions& o,
                       std::span<const Transmitter> access_points) {
  const WorldScene scene = view.scene();
  const RandomStream random = view.random(SimulationUse::kWifiNoise);
  const Point2 receiver = receiver_of(view, o.mount);
  WifiScan scan{view.stamp, {}};
  for (std::uint32_t i = 0; i < access_points.size(); ++i) {
    const double level = level_at(view, scene, access_points[i], receiver) + o.device_offset_db +
                         o.sigma_db * random.normal4(i, kNoise)[0];
    if (level < o.sensitivity_dbm || random.uniform(i, kFate) < o.missed_share) continue;
    scan.readings.push_back({access_points[i].id, static_cast<float>(std::min(level, 50.0))});
  }
  return scan;
}

BeaconRanges simulate_beacons(const SensorView& view, const WorldBeaconRadioOptions& o,
                              std::span<const Transmitter> beacons) {
  const WorldScene scene = view.scene();
  const RandomStream random = view.random(SimulationUse::kBeaconNoise);
  const Point2 receiver = receiver_of(view, o.mount);
  BeaconRanges heard{view.stamp, {}};
  for (std::uint32_t i = 0; i < beacons.size(); ++i) {
    const Point2& at = beacons[i].at;
    const double distance = std::hypot(at.x - receiver.x, at.y - receiver.y);
    if (distance > o.range_max_m) continue;
    const auto noise = random.normal4(i, kNoise);
    const double level = level_at(view, scene, beacons[i], receiver) + o.sigma_db * noise[1];
    if (level < o.sensitivity_dbm || random.uniform(i, kFate) < o.missed_share) continue;
    BeaconReading reading{beacons[i].id};
    if (o.levels) reading.rssi_dbm = std::min(level, 50.0);
    if (o.ranges) {
      const int walls = walls_on_line(scene, receiver, at);
      const WorldTransmitterOptions& beacon = beacons[i].options;
      const double late_m = delay_m(walls, o.nlos_mean_m, random, i) + obstruction_m(beacon, random, i);
      const double slant = std::hypot(distance, beacon.height_m - o.height_m);
      const auto wrong = random.uniform4(i, kWrong);
      const double range = wrong[0] < beacon.wrong_share
                               ? wrong[1] * slant
                               : slant + o.bias_m + late_m + o.sigma_range_m * noise[0];
      reading.range_m = std::max(0.0, range);
    }
    heard.readings.push_back(std::move(reading));
  }
  return heard;
}

}  // namespace cairn
