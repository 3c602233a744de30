#include "cairn/io/exact_messages.hpp"

#include "cairn/io/cdr.hpp"

#include <array>
#include <charconv>

namespace cairn::exact {
namespace {

constexpr std::size_t kMaxStreams = 256;
constexpr const char* kStream = "cairn.stream";
constexpr const char* kName = "cairn.name";
constexpr const char* kFrame = "cairn.frame";
constexpr const char* kKind = "cairn.kind";
constexpr const char* kMount = "cairn.T_base_sensor";

constexpr std::string_view kOdometrySchema =
    "# A pose of the odometry as Cairn took it. Times in nanoseconds.\n"
    "int64 event_stamp\nint64 arrival\nint64 stamp\nfloat64 x\nfloat64 y\nfloat64 theta\n";
constexpr std::string_view kLaserScanSchema =
    "# A scan as Cairn took it: sensor_msgs/LaserScan with angles and limits in double precision.\n"
    "int64 event_stamp\nint64 arrival\nint64 stamp\nfloat64 angle_min\nfloat64 angle_increment\n"
    "float64 range_min\nfloat64 range_max\nfloat32[] ranges\n";

void put(cdr::Writer& fields, Time time) { fields.number(std::int64_t{time.time_since_epoch().count()}); }
Time take_time(cdr::Reader& fields) { return Time(Duration(fields.number<std::int64_t>())); }

void put(cdr::Writer& fields, const Odometry& odometry) {
  put(fields, odometry.stamp);
  const Pose2& pose = odometry.T_odom_base;
  fields.number(pose.x).number(pose.y).number(pose.theta);
}

void put(cdr::Writer& fields, const std::shared_ptr<const LaserScan>& scan) {
  put(fields, scan->stamp);
  fields.number(scan->angle_min_rad).number(scan->angle_increment_rad);
  fields.number(scan->range_min_m).number(scan->range_max_m);
  fields.numbers(std::span<const float>(scan->ranges_m));
}

Odometry take_odometry(cdr::Reader& fields) {
  Odometry odometry{take_time(fields), {}};
  Pose2& pose = odometry.T_odom_base;
  for (double* value : {&pose.x, &pose.y, &pose.theta}) *value = fields.number<double>();
  return odometry;
}

std::shared_ptr<const LaserScan> take_scan(cdr::Reader& fields) {
  auto scan = std::make_shared<LaserScan>();
  scan->stamp = take_time(fields);
  for (double* value :
       {&scan->angle_min_rad, &scan->angle_increment_rad, &scan->range_min_m, &scan->range_max_m}) {
    *value = fields.number<double>();
  }
  scan->ranges_m = fields.numbers<float>();
  return scan;
}

// The text of a key, or "".
std::string_view value_of(const mcap::Texts& texts, const char* key) {
  const auto found = texts.find(key);
  return found == texts.end() ? std::string_view() : std::string_view(found->second);
}

const char* name_of(StreamKind kind) { return kind == StreamKind::kOdometry ? "odometry" : "laser_scan"; }

}  // namespace

std::string_view type_of(StreamKind kind) { return kind == StreamKind::kOdometry ? kOdometry : kLaserScan; }

std::string_view schema(StreamKind kind) {
  return kind == StreamKind::kOdometry ? kOdometrySchema : kLaserScanSchema;
}

std::string encode(const Event& event) {
  cdr::Writer fields;
  put(fields, event.stamp);
  put(fields, event.arrival);
  std::visit([&](const auto& payload) { put(fields, payload); }, event.payload);
  return std::move(fields).bytes();
}

Event decode(StreamKind kind, StreamId stream, std::string_view bytes) {
  cdr::Reader fields(bytes);
  Event event{take_time(fields), take_time(fields), stream, {}};
  if (kind == StreamKind::kOdometry) {
    event.payload = take_odometry(fields);
  } else {
    event.payload = take_scan(fields);
  }
  ros::require(fields.ok(), "it ends early");
  return event;
}

mcap::Texts to_texts(StreamId stream, const StreamInfo& info) {
  // A member that StreamInfo gains must be recorded, too: then this line no longer compiles.
  const auto& [name, kind, frame, T_base_sensor] = info;
  mcap::Texts texts{
      {kStream, std::to_string(stream)}, {kName, name}, {kKind, name_of(kind)}, {kFrame, frame}};
  if (T_base_sensor) texts[kMount] = to_text(*T_base_sensor);
  return texts;
}

std::optional<std::pair<StreamId, StreamInfo>> stream_of(const mcap::Texts& texts) {
  const auto number = to_double(value_of(texts, kStream));
  const std::string_view kind_name = value_of(texts, kKind);
  const StreamKind kind =
      kind_name == name_of(StreamKind::kOdometry) ? StreamKind::kOdometry : StreamKind::kLaserScan;
  if (!number || !(*number >= 0 && *number < kMaxStreams) || kind_name != name_of(kind)) return std::nullopt;
  StreamInfo info{std::string(value_of(texts, kName)), kind, std::string(value_of(texts, kFrame)),
                  std::nullopt};
  if (texts.contains(kMount)) info.T_base_sensor = to_pose(value_of(texts, kMount));
  return std::pair(static_cast<StreamId>(*number), std::move(info));
}

std::string to_text(double value) {
  std::array<char, 32> text;  // the longest has 24 characters
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end.ptr};
}

std::optional<double> to_double(std::string_view text) {
  double value = 0.0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_whole = end.ec == std::errc() && end.ptr == text.data() + text.size();
  return is_whole ? std::optional(value) : std::nullopt;
}

std::string to_text(const Pose2& pose) {
  return to_text(pose.x) + " " + to_text(pose.y) + " " + to_text(pose.theta);
}

std::optional<Pose2> to_pose(std::string_view text) {
  const std::size_t first = text.find(' ');
  const std::size_t last = text.rfind(' ');
  if (first == std::string_view::npos || first == last) return std::nullopt;
  const auto x = to_double(text.substr(0, first));
  const auto y = to_double(text.substr(first + 1, last - first - 1));
  const auto theta = to_double(text.substr(last + 1));
  if (!x || !y || !theta) return std::nullopt;
  return Pose2{*x, *y, *theta};
}

}  // namespace cairn::exact
