#include "cairn/io/exact_messages.hpp"

#include "cairn/io/cdr.hpp"

#include <array>
#include <charconv>

namespace cairn::exact {
namespace {

constexpr std::size_t kMaxStreams = 256;
constexpr const char* kStream = "cairn.stream";
constexpr const char* kName = "cairn.name";
constexpr const char* kFrame = "cairn.frame";
constexpr const char* kKind = "cairn.kind";
constexpr const char* kMount = "cairn.T_base_sensor";

void put(cdr::Writer& fields, Time time) { fields.number(std::int64_t{time.time_since_epoch().count()}); }
Time take_time(cdr::Reader& fields) { return Time(Duration(fields.number<std::int64_t>())); }

// The text of a key, or "".
std::string_view value_of(const mcap::Texts& texts, const char* key) {
  const auto found = texts.find(key);
  return found == texts.end() ? std::string_view() : std::string_view(found->second);
}

}  // namespace

std::string encode(const Event& event) {
  cdr::Writer fields;
  put(fields, event.stamp);
  put(fields, event.arrival);
  put_payload(fields, event.payload);
  return std::move(fields).bytes();
}

Event decode(StreamKind kind, StreamId stream, std::string_view bytes) {
  cdr::Reader fields(bytes);
  Event event{take_time(fields), take_time(fields), stream, {}};
  event.payload = take_payload(kind, fields);
  ros::require(fields.ok(), "it ends early");
  return event;
}

mcap::Texts to_texts(StreamId stream, const StreamInfo& info) {
  // A member that StreamInfo gains must be recorded, too: then this line no longer compiles.
  const auto& [name, kind, frame, T_base_sensor] = info;
  mcap::Texts texts{
      {kStream, std::to_string(stream)}, {kName, name}, {kKind, std::string(name_of(kind))}, {kFrame, frame}};
  if (T_base_sensor) texts[kMount] = to_text(*T_base_sensor);
  return texts;
}

std::optional<std::pair<StreamId, StreamInfo>> stream_of(const mcap::Texts& texts) {
  const auto number = to_double(value_of(texts, kStream));
  const auto kind = stream_kind_named(value_of(texts, kKind));
  if (!number || !(*number >= 0 && *number < kMaxStreams) || !kind) return std::nullopt;
  StreamInfo info{std::string(value_of(texts, kName)), *kind, std::string(value_of(texts, kFrame)),
                  std::nullopt};
  if (texts.contains(kMount)) info.T_base_sensor = to_pose(value_of(texts, kMount));
  return std::pair(static_cast<StreamId>(*number), std::move(info));
}

std::string to_text(double value) {
  std::array<char, 32> text;  // the longest has 24 characters
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end.ptr};
}

std::optional<double> to_double(std::string_view text) {
  double value = 0.0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_whole = end.ec == std::errc() && end.ptr == text.data() + text.size();
  return is_whole ? std::optional(value) : std::nullopt;
}

std::string to_text(const Pose2& pose) {
  return to_text(pose.x) + " " + to_text(pose.y) + " " + to_text(pose.theta);
}

std::optional<Pose2> to_pose(std::string_view text) {
  const std::size_t first = text.find(' ');
  const std::size_t last = text.rfind(' ');
  if (first == std::string_view::npos || first == last) return std::nullopt;
  const auto x = to_double(text.substr(0, first));
  const auto y = to_double(text.substr(first + 1, last - first - 1));
  const auto theta = to_double(text.substr(last + 1));
  if (!x || !y || !theta) return std::nullopt;
  return Pose2{*x, *y, *theta};
}

}  // namespace cairn::exact
