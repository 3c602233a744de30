#include "cairn/sim/world_recording.hpp"

#include "cairn/sim/world_odometry.hpp"

#include <algorithm>

namespace cairn {
namespace {

constexpr std::size_t kOdometryStream = 0;
constexpr std::size_t kBatch = 64;  // events that are made together: 40 MB of large pictures

// The odometry at the rate of its messages.
std::vector<Odometry> odometry_messages(const RobotDrive& drive, const WorldOdometryOptions& options,
                                        std::uint64_t seed) {
  const Duration period = duration_from_seconds(1.0 / options.rate_hz);
  Time next = drive.truth.front().stamp;
  std::vector<Odometry> messages;
  for (const Odometry& odometry : simulate_world_odometry(drive, options, seed)) {
    if (odometry.stamp < next) continue;
    while (next <= odometry.stamp) next += period;
    messages.push_back(odometry);
  }
  return messages;
}

}  // namespace

WorldSimulation::WorldSimulation(const World& world, std::uint64_t seed)
    : world_(world),
      seed_(seed),
      drive_(drive_mission(world, seed)),
      people_(world, drive_.truth, seed),
      walls_(world.solid, kAllMaterials),
      sensors_(make_sensors(world, drive_.truth.back().stamp, seed)),
      odometry_(odometry_messages(drive_, world.options.robot.odometry, seed)),
      streams_{{"odom", StreamKind::kOdometry, "odom", std::nullopt}} {
  for (const WorldSensor& sensor : sensors_) streams_.push_back(sensor.info);
}

std::vector<WorldSimulation::Message> WorldSimulation::schedule() const {
  std::vector<Message> messages;
  const Duration latency = duration_from_seconds(world_.options.robot.odometry.latency_s);
  for (std::size_t i = 0; i < odometry_.size(); ++i) {
    const Time stamp = odometry_[i].stamp;
    messages.push_back({kOdometryStream, i, {i, stamp, stamp, stamp + latency}});
  }
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    for (const MessageTiming& timing :
         message_timings(sensors_[i].timing, drive_.truth.back().stamp, i, seed_))
      messages.push_back({i + 1, 0, timing});
  }
  // Stable: odometry before the scan that arrives with it, so that a scan is not ahead of what the wheels
  // told.
  std::stable_sort(messages.begin(), messages.end(),
                   [](const Message& a, const Message& b) { return a.timing.arrival < b.timing.arrival; });
  return messages;
}

Event WorldSimulation::make(const Message& message, const SimulatedDrive& drive) const {
  const MessageTiming& t = message.timing;
  const auto stream = static_cast<StreamId>(message.stream);
  if (message.stream == kOdometryStream) return {t.stamp, t.arrival, stream, odometry_[message.odometry]};
  const std::size_t sensor = message.stream - 1;
  const SensorView view{drive, sensor, t.index, t.measured, t.stamp};
  return {t.stamp, t.arrival, stream, sensors_[sensor].measure(view)};
}

void WorldSimulation::run(const Executor& executor, const std::function<void(Event&&)>& take) const {
  const SimulatedDrive drive{world_, walls_, people_, drive_.truth, seed_, drive_.kidnapped_to};
  const std::vector<Message> messages = schedule();
  std::vector<Event> made, next;
  const auto hand_over = [&] {
    for (Event& event : made) take(std::move(event));
  };
  for (std::size_t first = 0; first < messages.size(); first += kBatch) {
    next.resize(std::min(kBatch, messages.size() - first));
    // Item 0 hands the events before these over, which takes as long as making them where they are large.
    executor.for_each_chunk(next.size() + 1, 1, [&](std::size_t item, std::size_t) {
      item == 0 ? hand_over() : static_cast<void>(next[item - 1] = make(messages[first + item - 1], drive));
    });
    std::swap(made, next);
  }
  hand_over();
}

WorldRecording record_world(const World& world, std::uint64_t seed, const Executor& executor) {
  const WorldSimulation simulation(world, seed);
  WorldRecording recording{simulation.streams(), {}, simulation.truth()};
  simulation.run(executor, [&recording](Event&& event) { recording.events.push_back(std::move(event)); });
  return recording;
}

}  // namespace cairn
