#include "cairn/io/ros_log.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace cairn::ros {
namespace {

constexpr std::size_t kMaxStreams = 256;
constexpr std::size_t kMaxTextBytes = 200;
constexpr double kMaxTilt = degrees_to_radians(5.0);

// Names come from the file and end in reports: plain ASCII of bounded length.
std::string printable(std::string_view text) {
  std::string result(text.substr(0, kMaxTextBytes));
  std::replace_if(
      result.begin(), result.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return result;
}

std::string_view last_part(std::string_view frame) { return frame.substr(frame.rfind('/') + 1); }

bool is_base(std::string_view frame) {
  return last_part(frame) == "base_footprint" || last_part(frame) == "base_link";
}

bool is_odometry(const StampedTransform& transform) {
  const std::string_view parent = last_part(transform.header.frame_id);
  return (parent == "odom" || parent == "odom_combined") && is_base(transform.child_frame_id);
}

}  // namespace

RosLog::RosLog(std::string name, std::size_t max_bytes) : name_(std::move(name)), bytes_left_(max_bytes) {}

std::string RosLog::where(const Message& message) const {
  return name_ + " (" + message.offset_unit + " " + std::to_string(message.offset) + ")";
}

void RosLog::skip(const Message& message, const std::string& note) {
  diagnostics().count("unsupported message (" + printable(message.type) + printable(note) + ")");
}

void RosLog::take(const Message& message, Handle handle) {
  try {
    handle(*this, message);
  } catch (const MalformedMessage& error) {
    diagnostics().warn("malformed message", where(message),
                       printable(message.type) + " on " + printable(message.topic) + ": " + error.what());
  }
}

void RosLog::add(const Message& message, LaserScanMessage decoded) {
  Source& laser = source(message.topic, StreamKind::kLaserScan, decoded.header, decoded.header.frame_id);
  decoded.scan.stamp = stamp_or_arrival(decoded.header, message);
  const std::size_t bytes = sizeof(LaserScan) + decoded.scan.ranges_m.size() * sizeof(float);
  add_event(message, laser, decoded.scan.stamp, bytes,
            std::make_shared<const LaserScan>(std::move(decoded.scan)));
}

void RosLog::add(const Message& message, const StampedTransform& odometry) {
  add_pose(message, message.topic, odometry);
}

void RosLog::add(const Message& message, const std::vector<StampedTransform>& transforms) {
  for (const StampedTransform& transform : transforms) {
    const std::string link = transform.header.frame_id + "->" + transform.child_frame_id;
    if (!transform.T_parent_child) {
      diagnostics().warn("malformed transform", where(message),
                         "tf " + printable(link) + " is not finite, or its rotation is none");
      continue;
    }
    frames_.add(transform);
    if (is_odometry(transform)) add_pose(message, "tf:" + link, transform);
  }
}

void RosLog::add_pose(const Message& message, std::string_view stream, const StampedTransform& transform) {
  Source& odometry = source(stream, StreamKind::kOdometry, transform.header, transform.child_frame_id);
  const Time stamp = stamp_or_arrival(transform.header, message);
  add_event(message, odometry, stamp, 0, Odometry{stamp, planar(*transform.T_parent_child)});
}

Time RosLog::stamp_or_arrival(const Header& header, const Message& message) {
  if (header.stamp != Time()) return header.stamp;
  diagnostics().warn("no stamp", where(message),
                     printable(message.topic) + ": the time of recording is used");
  return message.arrival;
}

void RosLog::add_event(const Message& message, Source& source, Time stamp, std::size_t bytes,
                       Event::Payload payload) {
  bytes += sizeof(Event);
  if (bytes > bytes_left_) {
    throw InputError(where(message), "the messages up to here fill the memory allowed for one log",
                     "split the bag or filter its topics");
  }
  bytes_left_ -= bytes;
  if (stamp < source.last_stamp) {
    diagnostics().warn("time reversal", where(message),
                       log_.streams[source.stream].name + ": stamp " + format_time(stamp) + " after " +
                           format_time(source.last_stamp));
  }
  source.last_stamp = stamp;
  log_.events.push_back({stamp, message.arrival, source.stream, std::move(payload)});
}

RosLog::Source& RosLog::source(std::string_view name, StreamKind kind, const Header& header,
                               const std::string& frame) {
  const auto [entry, is_new] = source_index_.try_emplace({kind, std::string(name), frame}, sources_.size());
  if (!is_new) return sources_[entry->second];
  if (sources_.size() == kMaxStreams) {
    source_index_.erase(entry);
    throw MalformedMessage("more than 256 streams in one log");
  }
  const std::string first_name = printable(name);
  const bool is_taken = std::any_of(log_.streams.begin(), log_.streams.end(),
                                    [&](const StreamInfo& info) { return info.name == first_name; });
  const std::string suffix = is_taken ? " (" + printable(frame) + ")" : "";
  const auto stream = static_cast<StreamId>(log_.streams.size());
  log_.streams.push_back({first_name + suffix, kind, printable(header.frame_id), std::nullopt});
  sources_.push_back({stream, frame, Time::min()});
  return sources_.back();
}

// --- after the last message --------------------------------------------------------------------------------

std::string RosLog::base_frame() const {
  std::string from_tf;
  std::string from_topic;
  for (const Source& source : sources_) {
    const StreamInfo& info = log_.streams[source.stream];
    if (info.kind != StreamKind::kOdometry) continue;
    std::string& base = info.name.starts_with("tf:") ? from_tf : from_topic;
    if (base.empty() || last_part(source.frame) == "base_footprint") base = source.frame;
  }
  if (!from_tf.empty()) return from_tf;
  if (!from_topic.empty()) return from_topic;
  return frames_.contains("base_footprint") ? "base_footprint" : "base_link";
}

void RosLog::resolve_mount(const std::string& base, const Source& laser) {
  StreamInfo& info = log_.streams[laser.stream];
  const auto T_base_sensor = frames_.constant_transform(base, laser.frame);
  if (!T_base_sensor) {
    diagnostics().warn("unknown mount", name_,
                       info.name + ": tf has no constant transform from " + printable(base) + " to " +
                           printable(laser.frame));
    return;
  }
  const double up = (T_base_sensor->rotation * Eigen::Vector3d::UnitZ()).z();
  if (std::abs(up) < std::cos(kMaxTilt)) {
    diagnostics().warn("unknown mount", name_, info.name + ": the laser is tilted by more than 5 degrees");
    return;
  }
  info.T_base_sensor = planar(*T_base_sensor);
  if (up < 0.0) mirror(laser.stream);
}

void RosLog::mirror(StreamId laser) {
  diagnostics().warn("inverted laser", name_,
                     log_.streams[laser].name + ": mounted upside down, its beams are mirrored");
  for (Event& event : log_.events) {
    if (event.stream != laser) continue;
    auto scan = std::make_shared<LaserScan>(*std::get<std::shared_ptr<const LaserScan>>(event.payload));
    scan->angle_min_rad = -scan->angle_min_rad;
    scan->angle_increment_rad = -scan->angle_increment_rad;
    event.payload = std::shared_ptr<const LaserScan>(std::move(scan));
  }
}

void RosLog::rebase(const std::string& base, const Source& odometry) {
  if (odometry.frame == base || odometry.frame.empty()) return;
  const auto T_child_base = frames_.constant_transform(odometry.frame, base);
  if (!T_child_base) {
    diagnostics().warn("odometry of another frame", name_,
                       log_.streams[odometry.stream].name + ": tf has no constant transform from " +
                           printable(odometry.frame) + " to the base " + printable(base));
    return;
  }
  for (Event& event : log_.events) {
    if (event.stream != odometry.stream) continue;
    Pose2& T_odom_child = std::get<Odometry>(event.payload).T_odom_base;
    T_odom_child = T_odom_child * planar(*T_child_base);
  }
}

Log RosLog::finish() && {
  const std::string base = base_frame();
  for (const Source& source : sources_) {
    const bool is_laser = log_.streams[source.stream].kind == StreamKind::kLaserScan;
    is_laser ? resolve_mount(base, source) : rebase(base, source);
  }
  return std::move(log_);
}

}  // namespace cairn::ros
