#pragma once

#include "cairn/io/frame_graph.hpp"
#include "cairn/io/input_file.hpp"
#include "cairn/io/log.hpp"
#include "cairn/io/ros_messages.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace cairn::ros {

/// A serialised message and where it came from.
struct Message {
  std::string_view type;  ///< "sensor_msgs/LaserScan"
  std::string_view topic;
  Time arrival;  ///< when it was recorded
  std::string_view bytes;
  std::uint64_t offset = 0;  ///< where it stands in the file, for the user
  const char* offset_unit = "byte offset";
};

/// Turns messages of ROS, in the order of their arrival, into a Log. What serialised them, ROS 1 or ROS 2, is
/// the business of ros1::Ros1Log and ros2::Ros2Log.
///
/// - sensor_msgs/LaserScan: a laser stream per topic (and frame_id, should it change).
/// - nav_msgs/Odometry: an odometry stream per topic (and child_frame_id).
/// - tf2_msgs/TFMessage: odom -> base_footprint or base_link becomes an odometry stream
///   "tf:odom->base_footprint"; constant transforms tell the lasers' mounts.
/// - All else is counted as "unsupported message (TYPE)".
///
/// The base frame is the child of odom in tf (base_footprint before base_link), else the child_frame_id of
/// the first odometry topic, else whichever of the two names tf knows. Odometry of another frame is carried
/// over to it by the constant transform between them.
///
/// A laser mounted upside down (roll = pi) sees left as right: beam a of the sensor looks at -a in the plane.
/// Its scans get angle_min and angle_increment negated, the ranges keep their order, and T_base_sensor is the
/// pose of an upright laser with the same forward direction. A laser tilted by more than 5 degrees, or whose
/// frame no constant transforms join to the base, has no mount.
///
/// Event::stamp is the header's stamp, or the arrival where the sender set none (counted as "no stamp").
class RosLog {
 public:
  /// Decodes the bytes of a message and calls one of the functions below.
  using Handle = void (*)(RosLog& log, const Message& message);

  /// @param name       of the file, for messages to the user
  /// @param max_bytes  of scans and poses kept; beyond it the functions below throw InputError
  explicit RosLog(std::string name, std::size_t max_bytes = kMaxInputBytes);

  /// Calls `handle` and counts a message that it finds malformed.
  void take(const Message& message, Handle handle);
  /// Counts a message of a type that nobody decodes. `note`: " of version ...", if the type is known.
  void skip(const Message& message, const std::string& note = "");

  void add(const Message& message, LaserScanMessage scan);
  void add(const Message& message, const StampedTransform& odometry);
  void add(const Message& message, const std::vector<StampedTransform>& transforms);

  /// Resolves the mounts and hands the log over; `format` is left to the caller.
  Log finish() &&;

  Diagnostics& diagnostics() { return log_.diagnostics; }

 private:
  struct Source {
    StreamId stream;
    std::string frame;  // of the laser, or the moving frame of an odometry
    Time last_stamp;
  };

  void add_pose(const Message& message, std::string_view stream, const StampedTransform& transform);
  void add_event(const Message& message, Source& source, Time stamp, std::size_t bytes,
                 Event::Payload payload);
  Time stamp_or_arrival(const Header& header, const Message& message);

  Source& source(std::string_view name, StreamKind kind, const Header& header, const std::string& frame);
  std::string base_frame() const;
  void resolve_mount(const std::string& base, const Source& laser);
  void mirror(StreamId laser);
  void rebase(const std::string& base, const Source& odometry);
  std::string where(const Message& message) const;

  std::string name_;
  std::size_t bytes_left_;
  Log log_;
  FrameGraph frames_;
  std::map<std::tuple<StreamKind, std::string, std::string>, std::size_t> source_index_;  // kind, name, frame
  std::vector<Source> sources_;  // one per stream, same order
};

}  // namespace cairn::ros
