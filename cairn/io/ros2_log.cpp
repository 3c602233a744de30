#include "cairn/io/ros2_log.hpp"

#include "cairn/io/chunk_compression.hpp"
#include "cairn/io/ros2_messages.hpp"
#include "cairn/io/unpack.hpp"

#include <algorithm>
#include <iterator>

namespace cairn::ros2 {
namespace {

constexpr std::size_t kMaxMessageBytes = std::size_t{256} << 20;

struct Handler {
  std::string_view type;
  ros::RosLog::Handle handle;
};

void add_scan(ros::RosLog& log, const ros::Message& m) { log.add(m, decode_laser_scan(m.bytes)); }
void add_odometry(ros::RosLog& log, const ros::Message& m) { log.add(m, decode_odometry(m.bytes)); }
void add_transforms(ros::RosLog& log, const ros::Message& m) { log.add(m, decode_transforms(m.bytes)); }

constexpr Handler kHandlers[] = {
    {"sensor_msgs/msg/LaserScan", add_scan},
    {"nav_msgs/msg/Odometry", add_odometry},
    {"tf2_msgs/msg/TFMessage", add_transforms},
};

}  // namespace

void Ros2Log::add(const ros::Message& message, std::string_view encoding) {
  const auto* const found =
      std::find_if(std::begin(kHandlers), std::end(kHandlers),
                   [&](const Handler& handler) { return handler.type == message.type; });
  if (found == std::end(kHandlers)) return skip(message);
  if (encoding != "cdr") return skip(message, " as " + std::string(encoding));
  if (packing_of(message.bytes) != Packing::kZstd) return take(message, found->handle);
  const Unpacked unpacked = unpack_zstd_frame(message.bytes, kMaxMessageBytes);
  ros::Message plain = message;  // bytes that do not unpack come out empty, which is no message
  plain.bytes =
      unpacked.state == UnpackState::kComplete ? std::string_view(unpacked.bytes) : std::string_view();
  take(plain, found->handle);
}

}  // namespace cairn::ros2
