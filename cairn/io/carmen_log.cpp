#include "cairn/io/carmen_log.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/io/text_log.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace cairn {
namespace {

using namespace std::string_view_literals;

constexpr std::array kUnsupported = {"TRUEPOS"sv,  "NMEAGGA"sv, "NMEARMC"sv, "NMEA-GGA"sv, "NMEA-RMC"sv,
                                     "SONAR"sv,    "BUMPER"sv,  "IMU"sv,     "POSITION"sv, "GLOBALPOS"sv,
                                     "SCANMARK"sv, "LASER3"sv,  "LASER4"sv,  "LASER5"sv,   "PANTILT"sv,
                                     "RFID"sv,     "WIFI"sv};

constexpr Duration kLongestDelay = std::chrono::seconds(10);
constexpr double kWidestScanRad = 4.0 * kPi;

struct Times {
  Time stamp;
  Time arrival;
};

Times read_times(FieldReader& fields) {
  const Time stamp = fields.time("ipc timestamp");
  fields.word("host name");
  const Time logged = fields.time("logger timestamp");
  fields.expect_end();
  const bool same_clock = logged >= stamp && logged - stamp <= kLongestDelay;
  return {stamp, same_clock ? logged : stamp};
}

// CARMEN's guess for scans that tell no angles; see the header.
void set_angles_by_count(LaserScan& scan) {
  const auto n = scan.ranges_m.size();
  const double intervals = static_cast<double>(n % 2 == 1 && n > 1 ? n - 1 : n);
  scan.angle_min_rad = -kPi / 2.0;
  scan.angle_increment_rad = kPi / intervals;
  if (n == 401) {
    scan.angle_min_rad = degrees_to_radians(-50.0);
    scan.angle_increment_rad = degrees_to_radians(0.25);
  }
}

long long read_count(FieldReader& fields, long long least) {
  const long long count = fields.integer("number of readings");
  if (count < least)
    fields.fail("number of readings is " + std::to_string(count), "it is at least " + std::to_string(least));
  return count;
}

std::string lower_case(std::string_view name) {
  std::string lower(name);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return lower;
}

void read_odom(FieldReader& fields, TextLogBuilder& builder) {
  const Pose2 pose = read_pose(fields);
  for (const char* meaning : {"translational velocity", "rotational velocity", "acceleration"})
    fields.number(meaning);
  const Times times = read_times(fields);
  builder.add_odometry(builder.stream("odom", StreamKind::kOdometry), times.stamp, times.arrival, pose);
}

/// A scan with, possibly, the robot's pose: what all laser messages come down to.
struct LaserMessage {
  std::shared_ptr<LaserScan> scan = std::make_shared<LaserScan>();
  std::optional<Pose2> T_odom_base;
  std::optional<Pose2> T_base_sensor;
};

void add_laser(const std::string& name, LaserMessage message, const Times& times, TextLogBuilder& builder) {
  message.scan->stamp = times.stamp;
  if (message.T_odom_base) {
    const StreamId odometry = builder.stream(name + "_odom", StreamKind::kOdometry);
    builder.add_odometry(odometry, times.stamp, times.arrival, *message.T_odom_base);
  }
  const StreamId stream = builder.stream(name, StreamKind::kLaserScan);
  if (message.T_base_sensor) builder.observe_mount(stream, *message.T_base_sensor);
  builder.add_scan(stream, times.arrival, std::move(message.scan));
}

// FLASER, RLASER
void read_old_laser(const std::string& name, FieldReader& fields, TextLogBuilder& builder) {
  LaserMessage message;
  message.scan->ranges_m = read_ranges(fields, read_count(fields, 1));
  set_angles_by_count(*message.scan);
  message.scan->range_min_m = kTextLogRangeMinM;
  read_pose(fields);  // of the laser, in corrected logs the corrected one: says nothing about the mount
  message.T_odom_base = read_pose(fields);
  add_laser(name, std::move(message), read_times(fields), builder);
}

void read_scanner_settings(FieldReader& fields, LaserScan& scan) {
  fields.integer("laser type");
  scan.angle_min_rad = fields.number("start angle");
  fields.number("field of view");
  scan.angle_increment_rad = fields.number("angular resolution");
  scan.range_max_m = fields.number("maximum range");
  if (scan.range_max_m <= 0.0) fields.fail("maximum range is not positive", "write metres");
  scan.range_min_m = kTextLogRangeMinM;
  fields.number("accuracy");
  fields.integer("remission mode");
}

void read_scan_with_settings(FieldReader& fields, LaserScan& scan) {
  read_scanner_settings(fields, scan);
  scan.ranges_m = read_ranges(fields, read_count(fields, 1));
  const double width = std::abs(scan.angle_increment_rad) * static_cast<double>(scan.ranges_m.size());
  if (std::abs(scan.angle_min_rad) > kWidestScanRad || width > kWidestScanRad) {
    fields.fail("the beams go round more than twice", "write angles in radians");
  }
  const long long remissions = read_count(fields, 0);
  for (long long i = 0; i < remissions; ++i) fields.maybe_not_finite("remission");
}

void read_robot_laser(const std::string& name, FieldReader& fields, TextLogBuilder& builder) {
  LaserMessage message;
  read_scan_with_settings(fields, *message.scan);
  const Pose2 T_odom_sensor = read_pose(fields);
  message.T_odom_base = read_pose(fields);
  message.T_base_sensor = between(*message.T_odom_base, T_odom_sensor);
  for (const char* meaning : {"translational velocity", "rotational velocity", "forward safety distance",
                              "side safety distance", "turn axis"}) {
    fields.maybe_not_finite(meaning);
  }
  add_laser(name, std::move(message), read_times(fields), builder);
}

void read_raw_laser(const std::string& name, FieldReader& fields, TextLogBuilder& builder) {
  LaserMessage message;
  read_scan_with_settings(fields, *message.scan);
  add_laser(name, std::move(message), read_times(fields), builder);
}

struct Mounts {
  std::optional<double> front_x_m;
  std::optional<double> rear_x_m;
};

void read_param(FieldReader& fields, Mounts& mounts) {
  const std::string_view name = fields.word("parameter name");
  if (name == "robot_frontlaser_offset") mounts.front_x_m = fields.number("offset of the front laser");
  if (name == "robot_rearlaser_offset") mounts.rear_x_m = fields.number("offset of the rear laser");
}

bool looks_like_a_name(std::string_view word) {
  return word[0] >= 'A' && word[0] <= 'Z' && std::all_of(word.begin(), word.end(), [](char c) {
           return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
         });
}

bool is_unsupported(std::string_view name) {
  return std::find(kUnsupported.begin(), kUnsupported.end(), name) != kUnsupported.end();
}

// `stem` followed by one digit.
bool is_numbered(std::string_view name, std::string_view stem) {
  return name.size() == stem.size() + 1 && name.starts_with(stem) && name.back() >= '0' && name.back() <= '9';
}

bool is_old_laser(std::string_view name) { return name == "FLASER" || name == "RLASER"; }

void read_message(FieldReader& fields, TextLogBuilder& builder, Mounts& mounts) {
  const std::string_view name = fields.word("message name");
  if (name == "ODOM") {
    read_odom(fields, builder);
  } else if (is_old_laser(name)) {
    read_old_laser(lower_case(name), fields, builder);
  } else if (is_numbered(name, "ROBOTLASER")) {
    read_robot_laser(lower_case(name), fields, builder);
  } else if (is_numbered(name, "RAWLASER")) {
    read_raw_laser(lower_case(name), fields, builder);
  } else if (name == "PARAM") {
    read_param(fields, mounts);
  } else if (name == "SYNC") {
    return;
  } else if (is_unsupported(name)) {
    builder.warn("unsupported message", std::string(name) + " is not read");
  } else if (looks_like_a_name(name) && !fields.at_end()) {
    builder.warn("unknown message", std::string(name.substr(0, 40)) + " is no message of CARMEN");
  } else {
    fields.fail("the line does not start with a message name", "check how the log was made");
  }
}

}  // namespace

bool is_carmen_message(std::string_view word) {
  return word == "ODOM" || word == "PARAM" || word == "SYNC" || is_old_laser(word) ||
         is_numbered(word, "ROBOTLASER") || is_numbered(word, "RAWLASER") || is_unsupported(word);
}

Log read_carmen_log(std::istream& input, const std::string& name) {
  Mounts mounts;
  Log log = read_text_log(input, name, "carmen", [&](FieldReader& fields, TextLogBuilder& builder) {
    read_message(fields, builder, mounts);
  });
  for (StreamInfo& stream : log.streams) {
    if (stream.name == "flaser" && mounts.front_x_m)
      stream.T_base_sensor = Pose2{*mounts.front_x_m, 0.0, 0.0};
    if (stream.name == "rlaser" && mounts.rear_x_m) stream.T_base_sensor = Pose2{*mounts.rear_x_m, 0.0, -kPi};
  }
  return log;
}

}  // namespace cairn
