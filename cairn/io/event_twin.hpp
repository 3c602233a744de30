#pragma once

#include "cairn/sensing/event.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// An event in the words of ROS 2.
namespace cairn::ros2 {

/// What the topic of a stream holds; "" where ROS 2 has no message for it.
std::string_view twin_type(StreamKind kind);

/// The messages, of that type, that say what the event says: one, a sensor_msgs/Range for each transducer of
/// a sonar, or none.
/// @param frame  of the sensor; transducers have `transducer_frame(frame, i)`
std::vector<std::string> twins(const Event& event, const std::string& frame);

/// "FRAME_0", "FRAME_1", ...
std::string transducer_frame(const std::string& frame, std::size_t transducer);

}  // namespace cairn::ros2
