#include "cairn/sim/office_recording.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <memory>

namespace cairn {
namespace {

constexpr StreamId kOdometryStream = 0;
constexpr StreamId kLaserStream = 1;

FloorPlan what_a_laser_sees(const OfficeWorld& world) {
  FloorPlan plan = world.building;
  plan.cylinders.insert(plan.cylinders.end(), world.people.begin(), world.people.end());
  return plan;
}

void add_odometry(const OfficeRecordingOptions& options, std::uint64_t seed, OfficeRecording& recording) {
  for (const Odometry& odometry : simulate_wheel_odometry(recording.truth, options.odometry, seed)) {
    recording.events.push_back({odometry.stamp, odometry.stamp, kOdometryStream, odometry});
  }
}

void add_scans(const OfficeRecordingOptions& options, std::uint64_t seed, OfficeRecording& recording) {
  const FloorPlan plan = what_a_laser_sees(recording.world);
  const auto every = static_cast<std::size_t>(options.scan_every);
  for (std::size_t i = 0; i < recording.truth.size(); i += every) {
    const auto& [stamp, T_map_base] = recording.truth[i];
    recording.events.push_back(
        {stamp, stamp, kLaserStream,
         std::make_shared<const LaserScan>(
             simulate_scan(plan, T_map_base * options.T_base_laser, stamp, options.laser, seed, i / every))});
  }
}

}  // namespace

OfficeRecording record_office(const OfficeRecordingOptions& options, std::uint64_t seed) {
  options.laser.validate();
  if (options.scan_every < 1) throw ConfigurationError("scan_every", "is not positive", "give 1 or more");
  OfficeWorld world = make_office(options.office, seed);
  Trajectory truth = drive_tour(world.start, world.tour, options.drive, options.duration);
  OccupancyGrid map = rasterize(world.building, {world.start.x, world.start.y}, options.map_resolution_m);
  OfficeRecording recording{{{"odom", StreamKind::kOdometry, "odom", std::nullopt},
                             {"laser", StreamKind::kLaserScan, "laser", options.T_base_laser}},
                            {},
                            std::move(truth),
                            std::move(map),
                            std::move(world)};
  add_odometry(options, seed, recording);
  add_scans(options, seed, recording);
  // Odometry before the scan of the same instant: a scan is then never ahead of what the wheels told.
  std::stable_sort(recording.events.begin(), recording.events.end(),
                   [](const Event& a, const Event& b) { return a.stamp < b.stamp; });
  return recording;
}

}  // namespace cairn
