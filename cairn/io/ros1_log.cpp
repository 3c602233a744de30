#include "cairn/io/ros1_log.hpp"

#include "cairn/io/ros1_messages.hpp"

#include <algorithm>
#include <iterator>

namespace cairn::ros1 {
namespace {

struct Handler {
  std::string_view type;
  std::string_view md5sum;
  ros::RosLog::Handle handle;
};

void add_scan(ros::RosLog& log, const ros::Message& m) { log.add(m, decode_laser_scan(m.bytes)); }
void add_odometry(ros::RosLog& log, const ros::Message& m) { log.add(m, decode_odometry(m.bytes)); }
void add_transforms(ros::RosLog& log, const ros::Message& m) { log.add(m, decode_transforms(m.bytes)); }

constexpr Handler kHandlers[] = {
    {"sensor_msgs/LaserScan", "90c7ef2dc6895d81024acba2ac42f369", add_scan},
    {"nav_msgs/Odometry", "cd5e73d190d741a2f92e81eda573aca7", add_odometry},
    {"tf2_msgs/TFMessage", "94810edda583a504dfda3829e70d7eec", add_transforms},
    {"tf/tfMessage", "94810edda583a504dfda3829e70d7eec", add_transforms},
};

}  // namespace

void Ros1Log::add(const ros::Message& message, std::string_view md5sum) {
  const auto* const found =
      std::find_if(std::begin(kHandlers), std::end(kHandlers),
                   [&](const Handler& handler) { return handler.type == message.type; });
  if (found == std::end(kHandlers)) return skip(message);
  if (found->md5sum != md5sum) return skip(message, " of version " + std::string(md5sum));
  take(message, found->handle);
}

}  // namespace cairn::ros1
