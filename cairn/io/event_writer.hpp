#pragma once

#include "cairn/io/mcap_writer.hpp"
#include "cairn/io/ros_messages.hpp"
#include "cairn/sensing/event.hpp"
#include "cairn/sensing/stream_info.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cairn {

/// The header that a recording of Cairn begins with: profile "ros2".
mcap::Header recording_header();

/// Writes the events of a log or of a running robot into an MCAP file, each twice: exactly
/// (exact_messages.hpp, topics /cairn/input/0, 1, ...), and in ROS 2's words for other tools.
///
/// | in the log | in ROS 2 |
/// |---|---|
/// | odometry | nav_msgs/Odometry on the stream's name; of one stream also tf odom -> base_link |
/// | laser scan | sensor_msgs/LaserScan on the stream's name |
/// | sonar scan | sensor_msgs/Range for each transducer, frames `FRAME_0`, ...; their poses once on
/// /tf_static | | depth image | sensor_msgs/Image on the stream's name, sensor_msgs/CameraInfo on
/// NAME/camera_info | | ceiling patch | sensor_msgs/Image (mono8) on the stream's name | | rate of turn |
/// sensor_msgs/Imu on the stream's name | | WiFi, beacons, landmarks | nothing: ROS 2 has no such message |
/// | mount of a sensor | tf base_link -> its frame, once on /tf_static |
///
/// A topic is the stream's name with a leading '/' and with '_' for what no topic may hold. A laser without a
/// frame gets `laser_N`, any other sensor `sensor_N`. The log time is the arrival.
class EventWriter {
 public:
  /// Writes the channels.
  /// @param odometry_stream  name of the stream that becomes tf; empty or unknown: the first
  EventWriter(mcap::Writer& writer, const std::vector<StreamInfo>& streams,
              std::string_view odometry_stream = {});

  /// @throws InputError for an event that does not fit its stream
  void add(const Event& event);
  /// How many there were: the sequence number of the next one.
  std::uint32_t events() const { return events_; }

  /// A message of ROS 2 on a topic of its own, marked as a repetition of what stands exactly elsewhere.
  std::uint16_t add_ros_channel(std::string_view topic, std::string_view type);
  void add_ros_message(std::uint16_t channel, std::uint32_t sequence, Time arrival, Time stamp,
                       std::string_view data);
  void add_transform(std::uint32_t sequence, Time arrival, const ros::StampedTransform& transform);

  Time last_arrival() const { return last_arrival_; }

 private:
  static constexpr std::uint16_t kNoChannel = 0;  // those of MCAP's writer begin at 1

  struct Stream {
    StreamKind kind;
    std::string frame;  ///< of the sensor
    std::uint16_t exact_channel;
    std::uint16_t ros_channel;   ///< of the twin, if there is any
    std::uint16_t info_channel;  ///< of the camera's intrinsics
    bool has_transducers;        ///< the poses of a sonar's transducers are written
  };

  void add_stream(StreamId id, const StreamInfo& info);
  void add_mounts(const std::vector<StreamInfo>& streams);
  std::string free_topic(std::string_view name);
  std::uint16_t schema_id(std::string_view type, std::string_view definition);
  void add_twin(const Event& event, Stream& stream);
  void add_static(const std::vector<ros::StampedTransform>& mounts, Time arrival);
  void add_transducers(const SonarScan& scan, Time arrival, Stream& stream);

  mcap::Writer& writer_;
  std::map<std::string, std::uint16_t, std::less<>> schemas_;  // by name
  std::vector<std::string> topics_;
  std::vector<Stream> streams_;
  std::uint16_t transforms_channel_ = kNoChannel;
  std::uint16_t static_channel_ = kNoChannel;
  std::optional<StreamId> odometry_stream_;
  Time last_arrival_;
  std::uint32_t events_ = 0;
};

}  // namespace cairn
