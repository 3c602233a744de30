#pragma once

#include "cairn/sensing/event.hpp"
#include "cairn/sim/sensor_timing.hpp"
#include "cairn/sim/sensor_view.hpp"

#include <functional>
#include <vector>

namespace cairn {

/// One sensor of a robot in a world: what its stream is called, when it measures, and what it then says.
struct WorldSensor {
  StreamInfo info;
  WorldTimingOptions timing;
  std::function<Event::Payload(const SensorView&)> measure;
};

/// All sensors of the world, in the order of the log's streams: lasers, sonars, depth cameras, WiFi and
/// beacon radios, landmark detectors, ceiling cameras, gyroscopes; each kind in the order of its table. They
/// refer to the world.
/// @param end  of the drive
std::vector<WorldSensor> make_sensors(const World& world, Time end, std::uint64_t seed);

}  // namespace cairn
