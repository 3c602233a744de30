#pragma once

#include "cairn/core/executor.hpp"
#include "cairn/sensing/event.hpp"
#include "cairn/sensing/stream_info.hpp"
#include "cairn/sim/mission.hpp"
#include "cairn/sim/world.hpp"

#include <cstdint>
#include <vector>

namespace cairn {

/// What a robot's drive through a world leaves behind, and what is true.
struct WorldRecording {
  std::vector<StreamInfo> streams;  ///< 0: "odom", then the lasers in their order
  std::vector<Event> events;        ///< in the order of their arrival
  Trajectory truth;                 ///< T_map_base, exact, 50 Hz
};

/// Simulates the whole recording. The same world and seed give the same bytes for any number of threads.
/// @throws ConfigurationError as drive_mission()
WorldRecording record_world(const World& world, std::uint64_t seed, const Executor& executor = Executor());

}  // namespace cairn
