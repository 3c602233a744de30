#include "cairn/io/carmen_writer.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/core/trajectory.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string>

namespace cairn {
namespace {

constexpr int kPoseDecimals = 6;
constexpr int kRangeDecimals = 3;
constexpr int kAngleDecimals = 9;
constexpr std::size_t kMostLasers = 9;

// The bytes depend on no locale.
void put(std::ostream& output, double value, int decimals) {
  std::array<char, 400> text;  // the longest double in fixed notation has 309 digits before the point
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals);
  output.put(' ').write(text.data(), end.ptr - text.data());
}

void put(std::ostream& output, const Pose2& pose) {
  for (const double value : {pose.x, pose.y, pose.theta}) put(output, value, kPoseDecimals);
}

void put_times(std::ostream& output, const Event& event) {
  output << ' ' << format_time(event.stamp) << " cairn " << format_time(event.arrival) << '\n';
}

[[noreturn]] void refuse(const std::string& what) {
  throw InputError("log", what, "a CARMEN log cannot hold it: write an .mcap log, or choose the streams");
}

/// What has to be known of the whole log before the first message is written.
struct Plan {
  Trajectory odometry;                ///< sorted
  std::vector<std::string> messages;  ///< per stream: "ODOM", "ROBOTLASER1", "RAWLASER2", ...
};

std::vector<std::string> name_messages(const Log& log) {
  std::vector<std::string> messages;
  std::size_t lasers = 0;
  for (const StreamInfo& stream : log.streams) {
    if (stream.kind == StreamKind::kOdometry) {
      messages.emplace_back("ODOM");
    } else if (stream.kind != StreamKind::kLaserScan) {
      refuse("has a stream '" + stream.name + "' of " + std::string(name_of(stream.kind)));
    } else {
      messages.emplace_back(stream.T_base_sensor ? "ROBOTLASER" : "RAWLASER")
          .append(std::to_string(++lasers));
    }
  }
  const auto odometries = std::count(messages.begin(), messages.end(), "ODOM");
  if (odometries != 1) refuse("has not one odometry stream");
  if (lasers > kMostLasers) refuse("has more than nine lasers");
  return messages;
}

Plan make_plan(const Log& log) {
  Plan plan{{}, name_messages(log)};
  for (const Event& event : log.events) {
    if (event.stream >= log.streams.size() || log.streams[event.stream].kind != kind_of(event)) {
      refuse("has an event that does not fit its stream");
    }
    if (const auto* odometry = std::get_if<Odometry>(&event.payload)) {
      plan.odometry.push_back({event.stamp, odometry->T_odom_base});
    }
  }
  sort_by_stamp(plan.odometry);
  if (plan.odometry.empty()) refuse("has no odometry message");
  return plan;
}

// A scan just before the first or after the last odometry message takes that one's pose.
Pose2 odometry_at(const Trajectory& odometry, Time stamp) {
  return pose_at(odometry, std::clamp(stamp, odometry.front().stamp, odometry.back().stamp)).value();
}

void put_scan(std::ostream& output, const LaserScan& scan) {
  const double field_of_view = scan.angle_increment_rad * static_cast<double>(scan.ranges_m.size());
  output << " 0";  // type of the scanner: unknown
  for (const double angle : {scan.angle_min_rad, field_of_view, scan.angle_increment_rad}) {
    put(output, angle, kAngleDecimals);
  }
  put(output, scan.range_max_m, kRangeDecimals);
  output << " 0 0 " << scan.ranges_m.size();  // accuracy and remission mode: unknown
  for (const float range : scan.ranges_m) {
    put(output, std::isfinite(range) ? double{range} : scan.range_max_m, kRangeDecimals);
  }
  output << " 0";  // remissions
}

void put_event(std::ostream& output, const Event& event, const Log& log, const Plan& plan) {
  output << plan.messages[event.stream];
  if (const auto* odometry = std::get_if<Odometry>(&event.payload)) {
    put(output, odometry->T_odom_base);
    output << " 0 0 0";  // speeds and acceleration
  } else {
    put_scan(output, *std::get<std::shared_ptr<const LaserScan>>(event.payload));
    if (const auto& T_base_sensor = log.streams[event.stream].T_base_sensor) {
      const Pose2 T_odom_base = odometry_at(plan.odometry, event.stamp);
      put(output, T_odom_base * *T_base_sensor);
      put(output, T_odom_base);
      output << " 0 0 0 0 0";  // speeds, safety distances, turn axis
    }
  }
  put_times(output, event);
}

void put_mount_parameter(std::ostream& output, const Log& log) {
  const auto laser = std::find_if(log.streams.begin(), log.streams.end(),
                                  [](const StreamInfo& s) { return s.kind == StreamKind::kLaserScan; });
  if (laser == log.streams.end() || !laser->T_base_sensor) return;
  const Pose2& mount = *laser->T_base_sensor;
  if (mount.y != 0.0 || mount.theta != 0.0) return;
  output << "PARAM robot_frontlaser_offset";
  put(output, mount.x, kPoseDecimals);
  output << " 0 cairn 0\n";
}

}  // namespace

void write_carmen_log(std::ostream& output, const Log& log) {
  const Plan plan = make_plan(log);
  output << "# CARMEN log, written by cairn\n";
  put_mount_parameter(output, log);
  for (const Event& event : log.events) put_event(output, event, log, plan);
}

void write_carmen_log(const std::filesystem::path& path, const Log& log) {
  std::ofstream file(path, std::ios::binary);
  write_carmen_log(file, log);
  file.close();
  if (!file) {
    throw InputError(path.string(), "cannot be written", "check the folder, its permissions and space");
  }
}

}  // namespace cairn
