#pragma once

#include "cairn/core/rng.hpp"

#include <cstdint>

namespace cairn {

/// What the simulator draws random numbers for. The values are part of the results: only ever append.
enum class SimulationUse : std::uint8_t {
  kLayout = 0,
  kFurniture = 1,
  kPeople = 2,
  kOdometryBias = 3,
  kOdometryNoise = 4,
  kLaserNoise = 5,
};

/// Random numbers of one use, at one step of it (a scan, an odometry increment).
inline RandomStream simulation_random(std::uint64_t seed, SimulationUse use, std::uint64_t step = 0) {
  constexpr int kStepBits = 56;
  return {seed, RandomPurpose::kSimulation, (static_cast<std::uint64_t>(use) << kStepBits) | step};
}

}  // namespace cairn
