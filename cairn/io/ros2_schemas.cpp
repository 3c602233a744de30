#include "cairn/io/ros2_schemas.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <array>
#include <iterator>

namespace cairn::ros2 {
namespace {

// The fields of each message; what they mean stands in the packages of ROS 2 that define them.
struct Definition {
  std::string_view type;
  std::string_view fields;
};

constexpr Definition kParts[] = {
    {"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"},
    {"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
    {"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Quaternion", "float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n"},
    {"sensor_msgs/RegionOfInterest",
     "uint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\nbool do_rectify\n"},
    {"geometry_msgs/Pose", "Point position\nQuaternion orientation\n"},
    {"geometry_msgs/Transform", "Vector3 translation\nQuaternion rotation\n"},
    {"geometry_msgs/Twist", "Vector3 linear\nVector3 angular\n"},
    {"geometry_msgs/PoseWithCovariance", "Pose pose\nfloat64[36] covariance\n"},
    {"geometry_msgs/TwistWithCovariance", "Twist twist\nfloat64[36] covariance\n"},
    {"geometry_msgs/TransformStamped",
     "std_msgs/Header header\nstring child_frame_id\nTransform transform\n"},
};

struct Schema {
  std::string_view type;
  std::string_view fields;
  std::array<std::string_view, 9> parts;  // the messages that it is made of; "": no more
};

constexpr Schema kSchemas[] = {
    {"sensor_msgs/msg/LaserScan",
     "std_msgs/Header header\nfloat32 angle_min\nfloat32 angle_max\nfloat32 angle_increment\nfloat32 "
     "time_increment\nfloat32 scan_time\nfloat32 range_min\nfloat32 range_max\nfloat32[] ranges\nfloat32[] "
     "intensities\n",
     {"std_msgs/Header", "builtin_interfaces/Time"}},
    {"nav_msgs/msg/Odometry",
     "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance "
     "pose\ngeometry_msgs/TwistWithCovariance twist\n",
     {"std_msgs/Header", "builtin_interfaces/Time", "geometry_msgs/PoseWithCovariance", "geometry_msgs/Pose",
      "geometry_msgs/Point", "geometry_msgs/Quaternion", "geometry_msgs/TwistWithCovariance",
      "geometry_msgs/Twist", "geometry_msgs/Vector3"}},
    {"sensor_msgs/msg/Range",
     "uint8 ULTRASOUND=0\nuint8 INFRARED=1\nstd_msgs/Header header\nuint8 radiation_type\nfloat32 "
     "field_of_view\nfloat32 min_range\nfloat32 max_range\nfloat32 range\n",
     {"std_msgs/Header", "builtin_interfaces/Time"}},
    {"sensor_msgs/msg/Image",
     "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\nuint32 "
     "step\nuint8[] data\n",
     {"std_msgs/Header", "builtin_interfaces/Time"}},
    {"sensor_msgs/msg/CameraInfo",
     "std_msgs/Header header\nuint32 height\nuint32 width\nstring distortion_model\nfloat64[] d\nfloat64[9] "
     "k\nfloat64[9] r\nfloat64[12] p\nuint32 binning_x\nuint32 binning_y\nRegionOfInterest roi\n",
     {"std_msgs/Header", "builtin_interfaces/Time", "sensor_msgs/RegionOfInterest"}},
    {"sensor_msgs/msg/Imu",
     "std_msgs/Header header\ngeometry_msgs/Quaternion orientation\nfloat64[9] "
     "orientation_covariance\ngeometry_msgs/Vector3 angular_velocity\nfloat64[9] "
     "angular_velocity_covariance\ngeometry_msgs/Vector3 linear_acceleration\nfloat64[9] "
     "linear_acceleration_covariance\n",
     {"std_msgs/Header", "builtin_interfaces/Time", "geometry_msgs/Quaternion", "geometry_msgs/Vector3"}},
    {"tf2_msgs/msg/TFMessage",
     "geometry_msgs/TransformStamped[] transforms\n",
     {"geometry_msgs/TransformStamped", "std_msgs/Header", "builtin_interfaces/Time",
      "geometry_msgs/Transform", "geometry_msgs/Vector3", "geometry_msgs/Quaternion"}},
    {"geometry_msgs/msg/PoseWithCovarianceStamped",
     "std_msgs/Header header\ngeometry_msgs/PoseWithCovariance pose\n",
     {"std_msgs/Header", "builtin_interfaces/Time", "geometry_msgs/PoseWithCovariance", "geometry_msgs/Pose",
      "geometry_msgs/Point", "geometry_msgs/Quaternion"}},
};

template <class Table>
const auto& entry_of(const Table& table, std::string_view type) {
  const auto* const found =
      std::find_if(std::begin(table), std::end(table), [&](const auto& entry) { return entry.type == type; });
  CAIRN_ASSERT(found != std::end(table));
  return *found;
}

}  // namespace

std::string schema(std::string_view type) {
  const Schema& wanted = entry_of(kSchemas, type);
  std::string text(wanted.fields);
  for (const std::string_view part : wanted.parts) {
    if (part.empty()) break;
    text.append(80, '=').append("\nMSG: ").append(part).append("\n");
    text += entry_of(kParts, part).fields;
  }
  return text;
}

}  // namespace cairn::ros2
