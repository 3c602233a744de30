#pragma once

#include "cairn/io/exact_payloads.hpp"
#include "cairn/io/mcap_records.hpp"
#include "cairn/sensing/event.hpp"
#include "cairn/sensing/stream_info.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <utility>

/// Events to the last bit. The messages of ROS round angles to float32 and turn a heading into a quaternion;
/// a recording that must replay bit for bit holds every event once more, as one of these messages (CDR, as
/// those of ROS 2) on a channel of its own. The channel's metadata tell the stream.
namespace cairn::exact {

/// The event but for its stream: stamps and arrival in nanoseconds, all numbers as wide as they are.
/// @throws ros::MalformedMessage for an event without a measurement
std::string encode(const Event& event);
/// @throws ros::MalformedMessage if the bytes end early or announce more than they hold. Values are not
///   judged: NaN comes back as NaN.
Event decode(StreamKind kind, StreamId stream, std::string_view bytes);

/// What a channel says of its stream, and back; nullopt unless it is such a channel. At most 256 streams.
mcap::Texts to_texts(StreamId stream, const StreamInfo& info);
std::optional<std::pair<StreamId, StreamInfo>> stream_of(const mcap::Texts& texts);

/// The shortest text that reads back as the same number, and back; nullopt for text that is none.
std::string to_text(double value);
std::optional<double> to_double(std::string_view text);
/// "x y theta"
std::string to_text(const Pose2& pose);
std::optional<Pose2> to_pose(std::string_view text);

}  // namespace cairn::exact
