#include "apps/cairn/sensor_error_arguments.hpp"

#include "apps/cairn/world_file.hpp"
#include "cairn/io/log_reader.hpp"
#include "cairn/io/map_reader.hpp"
#include "cairn/io/trajectory_reader.hpp"

#include <algorithm>

namespace cairn::app {

void add_sensor_error_options(CLI::App& command, SensorErrorArguments& a) {
  command.add_option("--log", a.log, "Recording")->required();
  command.add_option("--map", a.map, "Map (map_server YAML, Wean)")->required();
  command.add_option("--reference", a.reference, "Where the robot was")->required();
  command.add_option("--world", a.world,
                     "World file whose `beacons` tell where the beacons hang, and whose first beacon radio "
                     "where the antenna is");
  command.add_option("--odometry", a.odometry, "Odometry stream (default: the first)");
  add_posed_scan_options(command, a.scans);
}

SensorErrors measure(const SensorErrorArguments& a) {
  const PosedScanOptions scans = a.scans.options();
  const auto map = read_map(a.map);
  Log log = read_log(a.log);
  sort_by_stamp(log);
  TrajectoryOptions reading;
  const StreamId laser = laser_stream(log, scans.stream);
  for (const Event& event : log.events) {
    if (event.stream == laser) reading.frame_stamps.push_back(event.stamp);
  }
  Diagnostics unused;
  const Trajectory reference = read_trajectory(a.reference, reading, unused);
  std::optional<BeaconSites> beacons;
  if (!a.world.empty()) beacons = beacon_sites(read_world_options(a.world, {}, 1));
  return measure_sensor_errors({log, reference, *map, scans, a.odometry, beacons});
}

}  // namespace cairn::app
