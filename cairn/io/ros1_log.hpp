#pragma once

#include "cairn/io/frame_graph.hpp"
#include "cairn/io/input_file.hpp"
#include "cairn/io/log.hpp"
#include "cairn/io/ros1_messages.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace cairn::ros1 {

/// A serialised message and where it came from.
struct Message {
  std::string_view type;    ///< "sensor_msgs/LaserScan"
  std::string_view md5sum;  ///< of its definition: the version of the type
  std::string_view topic;
  Time arrival;  ///< when it was recorded
  std::string_view bytes;
  std::uint64_t offset = 0;  ///< byte offset of its record or chunk, for messages to the user
};

/// Turns ROS 1 messages, in the order of their arrival, into a Log.
///
/// - sensor_msgs/LaserScan: a laser stream per topic (and frame_id, should it change).
/// - nav_msgs/Odometry: an odometry stream per topic (and child_frame_id).
/// - tf2_msgs/TFMessage, tf/tfMessage: odom -> base_footprint or base_link becomes an odometry stream
///   "tf:odom->base_footprint"; constant transforms tell the lasers' mounts.
/// - All else is counted as "unsupported message (TYPE)", also a known type of another version.
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
class Ros1Log {
 public:
  /// @param name       of the file, for messages to the user
  /// @param max_bytes  of scans and poses kept; beyond it add() throws InputError
  explicit Ros1Log(std::string name, std::size_t max_bytes = kMaxInputBytes);

  void add(const Message& message);
  /// Resolves the mounts and hands the log over; `format` is left to the caller.
  Log finish() &&;

  Diagnostics& diagnostics() { return log_.diagnostics; }

 private:
  using Handle = void (Ros1Log::*)(const Message&);
  struct Handler {
    std::string_view type;
    std::string_view md5sum;
    Handle handle;
  };
  static const Handler kHandlers[];

  struct Source {
    StreamId stream;
    std::string frame;  // of the laser, or the moving frame of an odometry
    Time last_stamp;
  };

  const Handler* handler_of(const Message& message);
  void add_laser_scan(const Message& message);
  void add_odometry(const Message& message);
  void add_transforms(const Message& message);
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

}  // namespace cairn::ros1
