#pragma once

#include "cairn/core/executor.hpp"
#include "cairn/sensing/event.hpp"
#include "cairn/sensing/stream_info.hpp"
#include "cairn/sim/mission.hpp"
#include "cairn/sim/people.hpp"
#include "cairn/sim/sensor_rig.hpp"
#include "cairn/sim/world.hpp"

#include <cstdint>
#include <functional>
#include <vector>

namespace cairn {

/// A robot's drive through a world, and what its sensors say of it, one event after the other: pictures of a
/// long drive do not fit into memory. The same world and seed give the same bytes for any number of threads.
class WorldSimulation {
 public:
  /// Plans and drives the mission.
  /// @param world  must outlive the simulation
  /// @throws ConfigurationError as drive_mission()
  WorldSimulation(const World& world, std::uint64_t seed);

  /// 0: "odom", then the sensors in the order of make_sensors().
  const std::vector<StreamInfo>& streams() const { return streams_; }
  /// T_map_base, exact, 50 Hz.
  const Trajectory& truth() const { return drive_.truth; }

  /// Hands over all events in the order of their arrival. `take` is called by one thread at a time, while
  /// others work on the next events.
  void run(const Executor& executor, const std::function<void(Event&&)>& take) const;

 private:
  struct Message {
    std::size_t stream;
    std::size_t odometry;  ///< which of them, for the stream of the odometry
    MessageTiming timing;
  };
  std::vector<Message> schedule() const;
  Event make(const Message& message, const SimulatedDrive& drive) const;

  const World& world_;
  std::uint64_t seed_;
  RobotDrive drive_;
  People people_;
  WallGrid walls_;
  std::vector<WorldSensor> sensors_;
  std::vector<Odometry> odometry_;
  std::vector<StreamInfo> streams_;
};

/// What a robot's drive through a world leaves behind, and what is true.
struct WorldRecording {
  std::vector<StreamInfo> streams;  ///< as WorldSimulation's
  std::vector<Event> events;        ///< in the order of their arrival
  Trajectory truth;                 ///< T_map_base, exact, 50 Hz
};

/// Simulates the whole recording and keeps it in memory.
/// @throws ConfigurationError as drive_mission()
WorldRecording record_world(const World& world, std::uint64_t seed, const Executor& executor = Executor());

}  // namespace cairn
