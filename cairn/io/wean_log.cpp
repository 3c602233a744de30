#include "cairn/io/wean_log.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/io/text_log.hpp"

#include <utility>

namespace cairn {
namespace {

constexpr double kMetresPerUnit = 0.01;
constexpr long long kBeams = 180;

void read_odometry(FieldReader& fields, TextLogBuilder& builder) {
  const Pose2 pose = read_pose(fields, kMetresPerUnit);
  const Time stamp = fields.time("timestamp");
  fields.expect_end();
  builder.add_odometry(builder.stream("odom", StreamKind::kOdometry), stamp, stamp, pose);
}

void read_laser(FieldReader& fields, TextLogBuilder& builder) {
  const Pose2 T_odom_base = read_pose(fields, kMetresPerUnit);
  const Pose2 T_odom_sensor = read_pose(fields, kMetresPerUnit);
  auto scan = std::make_shared<LaserScan>();
  scan->ranges_m = read_ranges(fields, kBeams, kMetresPerUnit);
  scan->stamp = fields.time("timestamp");
  fields.expect_end();
  scan->angle_min_rad = -kPi / 2.0;
  scan->angle_increment_rad = degrees_to_radians(1.0);
  scan->range_min_m = kTextLogRangeMinM;
  const Time stamp = scan->stamp;
  builder.add_odometry(builder.stream("laser_odom", StreamKind::kOdometry), stamp, stamp, T_odom_base);
  const StreamId laser = builder.stream("laser", StreamKind::kLaserScan);
  builder.observe_mount(laser, between(T_odom_base, T_odom_sensor));
  builder.add_scan(laser, stamp, std::move(scan));
}

void read_message(FieldReader& fields, TextLogBuilder& builder) {
  const std::string_view name = fields.word("message name");
  if (name == "O") {
    read_odometry(fields, builder);
  } else if (name == "L") {
    read_laser(fields, builder);
  } else {
    fields.fail("the line starts neither with O nor with L", "check how the log was made");
  }
}

}  // namespace

Log read_wean_log(std::istream& input, const std::string& name) {
  return read_text_log(input, name, "wean", read_message);
}

Trajectory read_wean_trajectory(std::istream& input, const std::string& name) {
  Trajectory trajectory;
  LineReader line(input, name);
  while (line.next()) {
    FieldReader fields(line);
    if (fields.at_end()) continue;
    const std::string_view kind = fields.word("message name");
    if (kind != "O" && kind != "L")
      fields.fail("the line starts neither with O nor with L", "check the file");
    const Pose2 pose = read_pose(fields, kMetresPerUnit);
    if (kind == "L") read_pose(fields, kMetresPerUnit);
    if (kind == "L") read_ranges(fields, kBeams, kMetresPerUnit);
    trajectory.push_back({fields.time("timestamp"), pose});
    fields.expect_end();
  }
  if (trajectory.empty())
    throw InputError(name, "holds no pose", "check that it is a log of the Wean Hall data set");
  sort_by_stamp(trajectory);
  return trajectory;
}

}  // namespace cairn
