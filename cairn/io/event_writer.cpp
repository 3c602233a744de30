#include "cairn/io/event_writer.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/event_twin.hpp"
#include "cairn/io/exact_log.hpp"
#include "cairn/io/exact_messages.hpp"
#include "cairn/io/ros2_messages.hpp"
#include "cairn/io/ros2_schemas.hpp"
#include "cairn/io/ros2_sensor_messages.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

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

// What never moves needs no stamp.
ros::StampedTransform mounted(const std::string& parent, const std::string& child,
                              const ros::RigidTransform& T_parent_child) {
  ros::StampedTransform mount;
  mount.header.frame_id = parent;
  mount.child_frame_id = child;
  mount.T_parent_child = T_parent_child;
  return mount;
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
  const std::uint16_t schema = schema_id(exact::type_of(info.kind), exact::schema(info.kind));
  const std::uint16_t exact_channel =
      writer_.add_channel(schema, "/cairn/input/" + std::to_string(id), "cdr", exact::to_texts(id, info));
  const std::string_view type = ros2::twin_type(info.kind);
  const std::string topic = free_topic(info.name);
  const std::uint16_t ros_channel = type.empty() ? kNoChannel : add_ros_channel(topic, type);
  const std::uint16_t info_channel =
      info.kind == StreamKind::kDepthImage
          ? add_ros_channel(free_topic(topic + "/camera_info"), ros2::kCameraInfo)
          : kNoChannel;
  const std::string prefix = info.kind == StreamKind::kLaserScan ? "laser_" : "sensor_";
  const std::string frame = info.frame.empty() ? prefix + std::to_string(id) : info.frame;
  streams_.push_back({info.kind, frame, exact_channel, ros_channel, info_channel, false});
}

void EventWriter::add_mounts(const std::vector<StreamInfo>& streams) {
  std::vector<ros::StampedTransform> mounts;
  for (std::size_t i = 0; i < streams.size(); ++i) {
    const auto& T_base_sensor = streams[i].T_base_sensor;
    if (!T_base_sensor || streams_[i].frame == kBaseFrame) continue;
    mounts.push_back(mounted(kBaseFrame, streams_[i].frame, ros2::rigid(*T_base_sensor)));
  }
  add_static(mounts, {});
}

void EventWriter::add_static(const std::vector<ros::StampedTransform>& mounts, Time arrival) {
  if (mounts.empty()) return;
  if (static_channel_ == kNoChannel) static_channel_ = add_ros_channel("/tf_static", ros2::kTransforms);
  add_ros_message(static_channel_, 0, arrival, {}, ros2::encode_transforms(mounts));
}

// A sonar tells where its transducers are with each scan: the first is as good as any.
void EventWriter::add_transducers(const SonarScan& scan, Time arrival, Stream& stream) {
  if (std::exchange(stream.has_transducers, true)) return;
  std::vector<ros::StampedTransform> mounts;
  for (std::size_t i = 0; i < scan.T_sensor_transducer.size(); ++i)
    mounts.push_back(mounted(stream.frame, ros2::transducer_frame(stream.frame, i),
                             ros2::rigid(scan.T_sensor_transducer[i])));
  add_static(mounts, arrival);
}

void EventWriter::add(const Event& event) {
  const bool holds_something = visit_payload(event, [](const auto&) {});
  if (!holds_something || event.stream >= streams_.size() || streams_[event.stream].kind != kind_of(event)) {
    throw InputError("event " + std::to_string(events_), "does not fit the table of streams",
                     "give the recorder the streams that the events come from");
  }
  Stream& stream = streams_[event.stream];
  last_arrival_ = event.arrival;
  const std::string data = exact::encode(event);
  writer_.add_message(
      {stream.exact_channel, events_, mcap::to_mcap(event.arrival), mcap::to_mcap(event.stamp), data});
  add_twin(event, stream);
  ++events_;
}

void EventWriter::add_twin(const Event& event, Stream& stream) {
  if (const auto* scan = std::get_if<std::shared_ptr<const SonarScan>>(&event.payload))
    add_transducers(**scan, event.arrival, stream);
  if (const auto* image = std::get_if<std::shared_ptr<const DepthImage>>(&event.payload)) {
    add_ros_message(stream.info_channel, events_, event.arrival, event.stamp,
                    ros2::encode_camera_info({event.stamp, stream.frame}, **image));
  }
  for (const std::string& message : ros2::twins(event, stream.frame))
    add_ros_message(stream.ros_channel, events_, event.arrival, event.stamp, message);
  if (event.stream != odometry_stream_) return;
  const Pose2& pose = std::get<Odometry>(event.payload).T_odom_base;
  add_transform(events_, event.arrival, {{event.stamp, kOdometryFrame}, kBaseFrame, ros2::rigid(pose)});
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
