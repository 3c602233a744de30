#include "cairn/io/exact_payloads.hpp"

namespace cairn::exact {
namespace {

enum DepthUnit : std::uint8_t { kMillimetres = 0, kMetres = 1 };

struct MessageType {
  std::string_view type;
  std::string_view schema;
};

// In the order of StreamKind.
constexpr MessageType kTypes[kStreamKinds] = {
    {"cairn_msgs/msg/Odometry",
     "# A pose of the odometry as Cairn took it. Times in nanoseconds.\n"
     "int64 event_stamp\nint64 arrival\nint64 stamp\nfloat64 x\nfloat64 y\nfloat64 theta\n"},
    {"cairn_msgs/msg/LaserScan",
     "# A scan as Cairn took it: sensor_msgs/LaserScan with angles and limits in double precision.\n"
     "int64 event_stamp\nint64 arrival\nint64 stamp\nfloat64 angle_min\nfloat64 angle_increment\n"
     "float64 range_min\nfloat64 range_max\nfloat32[] ranges\n"},
    {"cairn_msgs/msg/SonarScan",
     "# One round of a ring of sonars. Transducers: x, y, theta of each in the sensor's frame.\n"
     "int64 event_stamp\nint64 arrival\nint64 stamp\nfloat64 range_min\nfloat64 range_max\nfloat64 cone\n"
     "float64[] transducers\nfloat32[] ranges\n"},
    {"cairn_msgs/msg/DepthImage",
     "# Depth along the optical axis, row by row: unit 0: depth_mm is filled (0: no reading), 1: depth_m.\n"
     "int64 event_stamp\nint64 arrival\nint64 stamp\nint32 width\nint32 height\nfloat64 fx\nfloat64 fy\n"
     "float64 cx\nfloat64 cy\nfloat64 mount_height\nfloat64 mount_pitch\nfloat64 range_min\n"
     "float64 range_max\nuint8 unit\nuint16[] depth_mm\nfloat32[] depth_m\n"},
    {"cairn_msgs/msg/WifiScan",
     "# The access points that were heard.\n"
     "int64 event_stamp\nint64 arrival\nint64 stamp\nAccessPoint[] readings\n"
     "================================================================================\n"
     "MSG: cairn_msgs/AccessPoint\nstring id\nfloat32 rssi_dbm\n"},
    {"cairn_msgs/msg/BeaconRanges",
     "# The beacons that were heard; NaN: not measured.\n"
     "int64 event_stamp\nint64 arrival\nint64 stamp\nBeacon[] readings\n"
     "================================================================================\n"
     "MSG: cairn_msgs/Beacon\nstring id\nfloat64 range\nfloat64 rssi_dbm\n"},
    {"cairn_msgs/msg/LandmarkDetections",
     "# The landmarks that were seen; id -1: not recognised.\n"
     "int64 event_stamp\nint64 arrival\nint64 stamp\nfloat64 range_max\nfloat64 field_of_view\n"
     "Landmark[] detections\n"
     "================================================================================\n"
     "MSG: cairn_msgs/Landmark\nint32 id\nfloat64 range\nfloat64 bearing\n"},
    {"cairn_msgs/msg/CeilingPatch",
     "# A grey picture of the ceiling, row by row, drawn as a map: x up, y to the left.\n"
     "int64 event_stamp\nint64 arrival\nint64 stamp\nint32 width\nint32 height\nfloat64 metres_per_pixel\n"
     "uint8[] gray\n"},
    {"cairn_msgs/msg/ImuYawRate",
     "# Rate of turn about the vertical, rad/s.\nint64 event_stamp\nint64 arrival\nint64 stamp\n"
     "float64 yaw_rate\n"},
};

void put_time(cdr::Writer& fields, Time time) {
  fields.number(std::int64_t{time.time_since_epoch().count()});
}
Time take_time(cdr::Reader& fields) { return Time(Duration(fields.number<std::int64_t>())); }

void take_into(cdr::Reader& fields, std::initializer_list<double*> values) {
  for (double* value : values) *value = fields.number<double>();
}

// --- one pair for each kind; the stamp stands before
// ---------------------------------------------------------

void put(cdr::Writer& fields, const Odometry& odometry) {
  const Pose2& pose = odometry.T_odom_base;
  fields.number(pose.x).number(pose.y).number(pose.theta);
}

void take(cdr::Reader& fields, Odometry& odometry) {
  Pose2& pose = odometry.T_odom_base;
  take_into(fields, {&pose.x, &pose.y, &pose.theta});
}

void put(cdr::Writer& fields, const LaserScan& scan) {
  fields.number(scan.angle_min_rad).number(scan.angle_increment_rad);
  fields.number(scan.range_min_m).number(scan.range_max_m);
  fields.numbers(std::span<const float>(scan.ranges_m));
}

void take(cdr::Reader& fields, LaserScan& scan) {
  take_into(fields, {&scan.angle_min_rad, &scan.angle_increment_rad, &scan.range_min_m, &scan.range_max_m});
  scan.ranges_m = fields.numbers<float>();
}

void put(cdr::Writer& fields, const SonarScan& scan) {
  fields.number(scan.range_min_m).number(scan.range_max_m).number(scan.cone_rad);
  std::vector<double> numbers;
  for (const Pose2& pose : scan.T_sensor_transducer)
    numbers.insert(numbers.end(), {pose.x, pose.y, pose.theta});
  fields.numbers(std::span<const double>(numbers)).numbers(std::span<const float>(scan.ranges_m));
}

void take(cdr::Reader& fields, SonarScan& scan) {
  take_into(fields, {&scan.range_min_m, &scan.range_max_m, &scan.cone_rad});
  const auto numbers = fields.numbers<double>();
  ros::require(numbers.size() % 3 == 0, "a transducer's pose is not three numbers");
  for (std::size_t i = 0; i < numbers.size(); i += 3)
    scan.T_sensor_transducer.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  scan.ranges_m = fields.numbers<float>();
}

void put(cdr::Writer& fields, const DepthImage& image) {
  const PinholeIntrinsics& k = image.intrinsics;
  fields.number(std::int32_t{image.width}).number(std::int32_t{image.height});
  for (const double value : {k.fx_px, k.fy_px, k.cx_px, k.cy_px, image.mount_height_m, image.mount_pitch_rad,
                             image.range_min_m, image.range_max_m})
    fields.number(value);
  const auto* millimetres = std::get_if<DepthImage::Millimetres>(&image.depths);
  const auto* metres = std::get_if<DepthImage::Metres>(&image.depths);
  fields.number(static_cast<std::uint8_t>(millimetres != nullptr ? kMillimetres : kMetres));
  fields.numbers(millimetres != nullptr ? std::span<const std::uint16_t>(*millimetres)
                                        : std::span<const std::uint16_t>());
  fields.numbers(metres != nullptr ? std::span<const float>(*metres) : std::span<const float>());
}

void take(cdr::Reader& fields, DepthImage& image) {
  image.width = fields.number<std::int32_t>();
  image.height = fields.number<std::int32_t>();
  PinholeIntrinsics& k = image.intrinsics;
  take_into(fields, {&k.fx_px, &k.fy_px, &k.cx_px, &k.cy_px, &image.mount_height_m, &image.mount_pitch_rad,
                     &image.range_min_m, &image.range_max_m});
  const auto unit = fields.number<std::uint8_t>();
  ros::require(unit <= kMetres, "its depths have an unknown unit");
  auto millimetres = fields.numbers<std::uint16_t>();
  auto metres = fields.numbers<float>();
  if (unit == kMillimetres) {
    image.depths = std::move(millimetres);
  } else {
    image.depths = std::move(metres);
  }
}

void put(cdr::Writer& fields, const WifiScan& scan) {
  fields.length(scan.readings.size());
  for (const AccessPointReading& reading : scan.readings) fields.text(reading.id).number(reading.rssi_dbm);
}

void take(cdr::Reader& fields, WifiScan& scan) {
  constexpr std::size_t kLeastBytes = 2 * sizeof(std::uint32_t);
  scan.readings.resize(fields.length(kLeastBytes));
  for (AccessPointReading& reading : scan.readings) {
    reading.id = fields.text();
    reading.rssi_dbm = fields.number<float>();
  }
}

void put(cdr::Writer& fields, const BeaconRanges& ranges) {
  fields.length(ranges.readings.size());
  for (const BeaconReading& reading : ranges.readings)
    fields.text(reading.id).number(reading.range_m).number(reading.rssi_dbm);
}

void take(cdr::Reader& fields, BeaconRanges& ranges) {
  constexpr std::size_t kLeastBytes = sizeof(std::uint32_t) + 2 * sizeof(double);
  ranges.readings.resize(fields.length(kLeastBytes));
  for (BeaconReading& reading : ranges.readings) {
    reading.id = fields.text();
    take_into(fields, {&reading.range_m, &reading.rssi_dbm});
  }
}

void put(cdr::Writer& fields, const LandmarkDetections& detections) {
  fields.number(detections.range_max_m).number(detections.field_of_view_rad);
  fields.length(detections.detections.size());
  for (const LandmarkDetection& d : detections.detections)
    fields.number(std::int32_t{d.id}).number(d.range_m).number(d.bearing_rad);
}

void take(cdr::Reader& fields, LandmarkDetections& detections) {
  take_into(fields, {&detections.range_max_m, &detections.field_of_view_rad});
  constexpr std::size_t kLeastBytes = sizeof(std::int32_t) + 2 * sizeof(double);
  detections.detections.resize(fields.length(kLeastBytes));
  for (LandmarkDetection& d : detections.detections) {
    d.id = fields.number<std::int32_t>();
    take_into(fields, {&d.range_m, &d.bearing_rad});
  }
}

void put(cdr::Writer& fields, const CeilingPatch& patch) {
  fields.number(std::int32_t{patch.width}).number(std::int32_t{patch.height}).number(patch.metres_per_pixel);
  fields.numbers(std::span<const std::uint8_t>(patch.gray));
}

void take(cdr::Reader& fields, CeilingPatch& patch) {
  patch.width = fields.number<std::int32_t>();
  patch.height = fields.number<std::int32_t>();
  take_into(fields, {&patch.metres_per_pixel});
  patch.gray = fields.numbers<std::uint8_t>();
}

void put(cdr::Writer& fields, const ImuYawRate& rate) { fields.number(rate.yaw_rate_radps); }
void take(cdr::Reader& fields, ImuYawRate& rate) { take_into(fields, {&rate.yaw_rate_radps}); }

// --- by kind
// -------------------------------------------------------------------------------------------------

template <class Measurement>
Event::Payload take_one(cdr::Reader& fields) {
  Measurement measurement;
  measurement.stamp = take_time(fields);
  take(fields, measurement);
  if constexpr (std::is_constructible_v<Event::Payload, Measurement>) {
    return measurement;
  } else {
    return std::make_shared<const Measurement>(std::move(measurement));
  }
}

using Take = Event::Payload (*)(cdr::Reader&);
constexpr Take kTakes[kStreamKinds] = {
    take_one<Odometry>,           take_one<LaserScan>,    take_one<SonarScan>,
    take_one<DepthImage>,         take_one<WifiScan>,     take_one<BeaconRanges>,
    take_one<LandmarkDetections>, take_one<CeilingPatch>, take_one<ImuYawRate>};

template <class Measurement>
void put_one(cdr::Writer& fields, const Measurement& measurement) {
  put_time(fields, measurement.stamp);
  put(fields, measurement);
}

}  // namespace

std::string_view type_of(StreamKind kind) { return kTypes[static_cast<std::size_t>(kind)].type; }
std::string_view schema(StreamKind kind) { return kTypes[static_cast<std::size_t>(kind)].schema; }

void put_payload(cdr::Writer& fields, const Event::Payload& payload) {
  std::visit(
      [&fields](const auto& value) {
        if constexpr (requires { *value; }) {
          ros::require(value != nullptr, "it holds no measurement");
          put_one(fields, *value);
        } else {
          put_one(fields, value);
        }
      },
      payload);
}

Event::Payload take_payload(StreamKind kind, cdr::Reader& fields) {
  return kTakes[static_cast<std::size_t>(kind)](fields);
}

}  // namespace cairn::exact
