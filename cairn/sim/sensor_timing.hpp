#pragma once

#include "cairn/core/time.hpp"
#include "cairn/sim/sensor_options.hpp"

#include <cstdint>
#include <vector>

namespace cairn {

/// One message of a sensor: when it was measured in truth, what its stamp says, and when it is heard of.
struct MessageTiming {
  std::uint64_t index = 0;  ///< of the measurement, also counting those that were lost
  Time measured;
  Time stamp;
  Time arrival;
};

/// All messages of a sensor from time zero to `end`, in the order of measuring. Lost ones are left out.
/// @param stream  sensors of different streams have independent faults
std::vector<MessageTiming> message_timings(const WorldTimingOptions& options, Time end, std::size_t stream,
                                           std::uint64_t seed);

}  // namespace cairn
