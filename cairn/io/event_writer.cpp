#include "cairn/io/event_writer.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/exact_log.hpp"
#include "cairn/io/exact_messages.hpp"
#include "cairn/io/ros2_messages.hpp"
#include "cairn/io/ros2_schemas.hpp"

#include <algorithm>
#include <cctype>

namespace cairn {
namespace {

constexpr const char* kBaseFrame = "base_link";
constexpr const char* kOdometryFrame = "odom";

std::string topic_of(std::string_view name) {
  std::string topic = name.starts_with('/') ? "" : "/";
  for (const char c : name) {
    const bool is_allowed = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '/' || c == '_';
    topic += is_allowed ? c : '_';
  }
  return topic;
}

StreamKind kind_of(const Event& event) {
  return std::holds_alternative<Odometry>(event.payload) ? StreamKind::kOdometry : StreamKind::kLaserScan;
}

std::optional<StreamId> stream_for_tf(const std::vector<StreamInfo>& streams, std::string_view wanted) {
  std::optional<StreamId> first;
  for (std::size_t i = 0; i < streams.size(); ++i) {
    if (streams[i].kind != StreamKind::kOdometry) continue;
    if (streams[i].name == wanted) return static_cast<StreamId>(i);
    if (!first) first = static_cast<StreamId>(i);
  }
  return first;
}

}  // namespace

mcap::Header recording_header() { return {"ros2", "cairn"}; }

EventWriter::EventWriter(mcap::Writer& writer, const std::vector<StreamInfo>& streams,
                         std::string_view odometry_stream)
    : writer_(writer), odometry_stream_(stream_for_tf(streams, odometry_stream)) {
  for (const char* topic : {"/tf", "/tf_static"}) topics_.emplace_back(topic);
  for (std::size_t i = 0; i < streams.size(); ++i) add_stream(static_cast<StreamId>(i), streams[i]);
  transforms_channel_ = add_ros_channel("/tf", ros2::kTransforms);
  add_mounts(streams);
}

std::uint16_t EventWriter::schema_id(std::string_view type, std::string_view definition) {
  const auto found = schemas_.find(type);
  if (found != schemas_.end()) return found->second;
  return schemas_[std::string(type)] = writer_.add_schema(type, "ros2msg", definition);
}

std::uint16_t EventWriter::add_ros_channel(std::string_view topic, std::string_view type) {
  return writer_.add_channel(schema_id(type, ros2::schema(type)), topic, "cdr", ExactLog::twin_mark());
}

std::string EventWriter::free_topic(std::string_view name) {
  const std::string wanted = topic_of(name);
  std::string topic = wanted;
  for (int i = 2; std::find(topics_.begin(), topics_.end(), topic) != topics_.end(); ++i) {
    topic = wanted + "_" + std::to_string(i);
  }
  topics_.push_back(topic);
  return topic;
}

void EventWriter::add_stream(StreamId id, const StreamInfo& info) {
  const bool is_laser = info.kind == StreamKind::kLaserScan;
  const std::uint16_t schema = schema_id(exact::type_of(info.kind), exact::schema(info.kind));
  const std::uint16_t exact_channel =
      writer_.add_channel(schema, "/cairn/input/" + std::to_string(id), "cdr", exact::to_texts(id, info));
  const std::uint16_t ros_channel =
      add_ros_channel(free_topic(info.name), is_laser ? ros2::kLaserScan : ros2::kOdometry);
  const std::string frame = info.frame.empty() ? "laser_" + std::to_string(id) : info.frame;
  streams_.push_back({info.kind, frame, exact_channel, ros_channel});
}

void EventWriter::add_mounts(const std::vector<StreamInfo>& streams) {
  std::vector<ros::StampedTransform> mounts;
  for (std::size_t i = 0; i < streams.size(); ++i) {
    const auto& T_base_sensor = streams[i].T_base_sensor;
    if (!T_base_sensor || streams_[i].frame == kBaseFrame) continue;
    ros::StampedTransform mount;
    mount.header.frame_id = kBaseFrame;
    mount.child_frame_id = streams_[i].frame;
    mount.T_parent_child = ros2::rigid(*T_base_sensor);
    mounts.push_back(std::move(mount));
  }
  if (mounts.empty()) return;
  const std::uint16_t channel = add_ros_channel("/tf_static", ros2::kTransforms);
  writer_.add_message({channel, 0, 0, 0, ros2::encode_transforms(mounts)});
}

void EventWriter::add(const Event& event) {
  if (event.stream >= streams_.size() || streams_[event.stream].kind != kind_of(event)) {
    throw InputError("event " + std::to_string(events_), "does not fit the table of streams",
                     "give the recorder the streams that the events come from");
  }
  const Stream& stream = streams_[event.stream];
  last_arrival_ = event.arrival;
  const std::string data = exact::encode(event);
  writer_.add_message(
      {stream.exact_channel, events_, mcap::to_mcap(event.arrival), mcap::to_mcap(event.stamp), data});
  add_twin(event, stream);
  ++events_;
}

void EventWriter::add_twin(const Event& event, const Stream& stream) {
  if (const auto* scan = std::get_if<std::shared_ptr<const LaserScan>>(&event.payload)) {
    const std::string data = ros2::encode_laser_scan({{event.stamp, stream.frame}, **scan});
    return add_ros_message(stream.ros_channel, events_, event.arrival, event.stamp, data);
  }
  const Pose2& pose = std::get<Odometry>(event.payload).T_odom_base;
  const ros::StampedTransform transform{{event.stamp, kOdometryFrame}, kBaseFrame, ros2::rigid(pose)};
  add_ros_message(stream.ros_channel, events_, event.arrival, event.stamp, ros2::encode_odometry(transform));
  if (event.stream == odometry_stream_) add_transform(events_, event.arrival, transform);
}

void EventWriter::add_ros_message(std::uint16_t channel, std::uint32_t sequence, Time arrival, Time stamp,
                                  std::string_view data) {
  writer_.add_message({channel, sequence, mcap::to_mcap(arrival), mcap::to_mcap(stamp), data});
}

void EventWriter::add_transform(std::uint32_t sequence, Time arrival,
                                const ros::StampedTransform& transform) {
  add_ros_message(transforms_channel_, sequence, arrival, transform.header.stamp,
                  ros2::encode_transforms({transform}));
}

}  // namespace cairn
