#pragma once

#include "cairn/io/cdr.hpp"
#include "cairn/sensing/event.hpp"

#include <string_view>

/// What an exact message holds after its two event times: the measurement itself, every number as wide as it
/// is. One type of message for each kind of stream.
namespace cairn::exact {

/// "cairn_msgs/msg/Odometry", "cairn_msgs/msg/LaserScan", ...
std::string_view type_of(StreamKind kind);
/// Definition of such a message, as ros2::schema gives it for those of ROS.
std::string_view schema(StreamKind kind);

/// @throws ros::MalformedMessage for a null pointer, and for more elements than a message can hold
void put_payload(cdr::Writer& fields, const Event::Payload& payload);
/// What is missing reads as zero, as in cdr::Reader.
/// @throws ros::MalformedMessage if it announces more than it holds, or a depth image of neither kind of
/// pixels
Event::Payload take_payload(StreamKind kind, cdr::Reader& fields);

}  // namespace cairn::exact
