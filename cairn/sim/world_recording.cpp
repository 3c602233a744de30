#include "cairn/sim/world_recording.hpp"

#include "cairn/sim/people.hpp"
#include "cairn/sim/sensor_timing.hpp"
#include "cairn/sim/world_laser.hpp"
#include "cairn/sim/world_odometry.hpp"

#include <algorithm>
#include <memory>

namespace cairn {
namespace {

constexpr StreamId kOdometryStream = 0;

struct ScanJob {
  std::size_t laser;
  MessageTiming timing;
};

void add_odometry(const World& world, const RobotDrive& drive, std::uint64_t seed,
                  WorldRecording& recording) {
  const WorldOdometryOptions& options = world.options.robot.odometry;
  const Duration period = duration_from_seconds(1.0 / options.rate_hz);
  Time next = drive.truth.front().stamp;
  for (const Odometry& odometry : simulate_world_odometry(drive, options, seed)) {
    if (odometry.stamp < next) continue;
    while (next <= odometry.stamp) next += period;
    recording.events.push_back({odometry.stamp, odometry.stamp + duration_from_seconds(options.latency_s),
                                kOdometryStream, odometry});
  }
}

std::vector<ScanJob> scan_jobs(const World& world, Time end, std::uint64_t seed) {
  std::vector<ScanJob> jobs;
  for (std::size_t i = 0; i < world.options.lasers.size(); ++i) {
    for (const MessageTiming& t : message_timings(world.options.lasers[i].timing, end, i, seed))
      jobs.push_back({i, t});
  }
  return jobs;
}

void add_scans(const World& world, std::uint64_t seed, const Executor& executor, WorldRecording& recording) {
  constexpr std::size_t kChunk = 16;
  const WallGrid walls(world.solid, kAllMaterials);
  const People people(world, recording.truth, seed);
  const std::vector<ScanJob> jobs = scan_jobs(world, recording.truth.back().stamp, seed);
  const std::size_t first = recording.events.size();
  recording.events.resize(first + jobs.size());
  executor.for_each_chunk(jobs.size(), kChunk, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [laser, timing] = jobs[i];
      LaserScan scan = simulate_world_scan(world, walls, people, recording.truth, world.options.lasers[laser],
                                           timing.measured, laser, timing.index, seed);
      scan.stamp = timing.stamp;
      recording.events[first + i] = {timing.stamp, timing.arrival, static_cast<StreamId>(laser + 1),
                                     std::make_shared<const LaserScan>(std::move(scan))};
    }
  });
}

}  // namespace

WorldRecording record_world(const World& world, std::uint64_t seed, const Executor& executor) {
  RobotDrive drive = drive_mission(world, seed);
  WorldRecording recording;
  recording.streams.push_back({"odom", StreamKind::kOdometry, "odom", std::nullopt});
  for (const WorldLaserOptions& laser : world.options.lasers) {
    recording.streams.push_back({laser.name, StreamKind::kLaserScan, laser.name,
                                 parse_world_pose("lasers." + laser.name + ".mount", laser.mount)});
  }
  add_odometry(world, drive, seed, recording);
  recording.truth = std::move(drive.truth);
  add_scans(world, seed, executor, recording);
  // Stable: odometry before the scan that arrives with it, so that a scan is not ahead of what the wheels
  // told.
  std::stable_sort(recording.events.begin(), recording.events.end(),
                   [](const Event& a, const Event& b) { return a.arrival < b.arrival; });
  return recording;
}

}  // namespace cairn
