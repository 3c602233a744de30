#pragma once

#include <cstddef>
#include <cstdint>

namespace cairn {

/// How a localizer judges its own estimate.
enum class TrackingState : std::uint8_t {
  kTracking,     ///< the pose is right as far as the sensors can tell
  kCrowded,      ///< likewise, but much of what is seen is in front of the map's walls: people, carts
  kAmbiguous,    ///< several places fit, or none is narrow enough; none of them is probable enough to rely on
  kLost,         ///< the pose is probably wrong
  kSensorFault,  ///< the sensors say nothing that could be judged
};
inline constexpr std::size_t kTrackingStateCount = 5;
const char* to_string(TrackingState state);

/// What a localizer thinks of its own pose, and the figures that led to it. Shares are those of the beams of
/// the last judged scan, 0..1; NaN where no sensor in use can tell.
struct Judgement {
  TrackingState state = TrackingState::kTracking;
  /// That T_map_base is right (within 1 m and 45 degrees of the truth), given all that was measured so far.
  double probability = 1.0;
  double explained = 0.0;   ///< ends at a wall of the map, or sees as far as the map leads to expect
  double blocked = 0.0;     ///< ends before the wall that the map leads to expect, at nothing that it knows
  double beyond = 0.0;      ///< passes through a wall of the map
  double fit = 0.0;         ///< log-likelihood per beam, 0 for the best possible scan
  double innovation = 0.0;  ///< distance that the measurement moved the pose, in metres; 1 rad counts as 1 m
  double entropy = 0.0;  ///< of the weights of the hypotheses, nat: 0 for one place, log n for n equal ones
  /// How far the pose has left the robot's own motion of the last metres (Reckoning), in metres; 0 where
  /// nothing tells of that.
  double drift = 0.0;
};

}  // namespace cairn
