#include "cairn/io/exact_log.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/exact_messages.hpp"
#include "cairn/io/input_file.hpp"
#include "cairn/io/ros_messages.hpp"
#include "cairn/sensing/defect.hpp"

#include <algorithm>

namespace cairn {
namespace {

constexpr const char* kTwin = "cairn.twin";

bool is_sensible(Time time) {
  const std::int64_t nanoseconds = time.time_since_epoch().count();
  return nanoseconds <= mcap::kLastNanosecond && nanoseconds >= -mcap::kLastNanosecond;
}

void check_sense(const Odometry& odometry) {
  ros::require(is_finite(odometry.T_odom_base), "its pose is not finite");
}
void check_sense(const LaserScan& scan) { ros::check_scan(scan); }
template <class Measurement>
void check_sense(const Measurement& measurement) {
  const char* const what = defect_of(measurement);
  ros::require(what == nullptr, what);
}

void check(const Event& event) {
  visit_payload(event, [&event](const auto& measurement) {
    const bool has_time =
        is_sensible(event.stamp) && is_sensible(event.arrival) && is_sensible(measurement.stamp);
    ros::require(has_time, "its stamps are beyond all times");
    check_sense(measurement);
  });
}

}  // namespace

ExactLog::ExactLog(std::string name, Values values)
    : name_(std::move(name)), values_(values), bytes_left_(kMaxInputBytes) {}

const mcap::Texts& ExactLog::twin_mark() {
  static const mcap::Texts mark{{kTwin, "true"}};
  return mark;
}

bool ExactLog::is_twin(const mcap::Channel& channel) const { return channel.metadata.contains(kTwin); }

void ExactLog::add_channel(const mcap::Channel& channel) {
  auto found = exact::stream_of(channel.metadata);
  if (!found) return;
  auto& [stream, info] = *found;
  const bool is_taken = std::any_of(streams_.begin(), streams_.end(),
                                    [id = stream](const auto& entry) { return entry.second == id; });
  if (is_taken) {
    log_.diagnostics.warn("damaged record", name_, "two channels for the stream " + std::to_string(stream));
    return;
  }
  if (log_.streams.size() <= stream) log_.streams.resize(stream + std::size_t{1});
  log_.streams[stream] = std::move(info);
  streams_.emplace(channel.id, stream);
}

bool ExactLog::add_message(const mcap::MessageView& message) {
  const auto stream = streams_.find(message.channel.id);
  if (stream == streams_.end()) return false;
  try {
    Event event = exact::decode(log_.streams[stream->second].kind, stream->second, message.message.data);
    if (values_ == Values::kChecked) check(event);
    add_event(std::move(event), message.offset, sizeof(Event) + message.message.data.size());
  } catch (const ros::MalformedMessage& error) {
    log_.diagnostics.warn("malformed message",
                          name_ + " (byte offset " + std::to_string(message.offset) + ")",
                          std::string("on an exact channel: ") + error.what());
  }
  return true;
}

void ExactLog::add_event(Event event, std::uint64_t offset, std::size_t bytes) {
  if (bytes > bytes_left_) {
    throw InputError(name_ + " (byte offset " + std::to_string(offset) + ")",
                     "the messages up to here fill the memory allowed for one log", "split the recording");
  }
  bytes_left_ -= bytes;
  log_.events.push_back(std::move(event));
}

Log ExactLog::finish() && { return std::move(log_); }

}  // namespace cairn
