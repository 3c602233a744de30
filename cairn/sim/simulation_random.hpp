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
  kMission = 6,
  kWalking = 7,
  kTiming = 8,
  kDelivery = 9,
  kOutages = 10,
  kSonarNoise = 11,
  kDepthNoise = 12,
  kWifiNoise = 13,
  kBeaconNoise = 14,
  kLandmarkNoise = 15,
  kCeilingTexture = 16,
  kCeilingNoise = 17,
  kGyroscopeBias = 18,
  kGyroscopeNoise = 19,
  kShadowing = 20,
  kStart = 21,
};

/// Random numbers of one use, at one step of it (a scan, an odometry increment).
inline RandomStream simulation_random(std::uint64_t seed, SimulationUse use, std::uint64_t step = 0) {
  constexpr int kStepBits = 56;
  return {seed, RandomPurpose::kSimulation, (static_cast<std::uint64_t>(use) << kStepBits) | step};
}

/// The step of something that happens per stream: streams do not share random numbers.
inline std::uint64_t step_of_stream(std::size_t stream, std::uint64_t index) {
  constexpr int kIndexBits = 40;
  return (static_cast<std::uint64_t>(stream) << kIndexBits) | index;
}

}  // namespace cairn
