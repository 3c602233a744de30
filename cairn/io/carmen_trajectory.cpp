#include "cairn/io/carmen_trajectory.hpp"

#include "cairn/io/pose_collector.hpp"

namespace cairn {
namespace {

void skip_numbers(FieldReader& fields, const char* count_meaning, const char* meaning) {
  const long long count = fields.integer(count_meaning);
  if (count < 0 || static_cast<unsigned long long>(count) > fields.fields_left()) {
    fields.fail("announces " + std::to_string(count) + " values, the line has " +
                    std::to_string(fields.fields_left()) + " fields left",
                "check for a cut line");
  }
  for (long long i = 0; i < count; ++i) fields.maybe_not_finite(meaning);
}

Pose2 read_either_pose(FieldReader& fields, CarmenPose which) {
  const Pose2 laser = read_pose_fields(fields);
  const Pose2 robot = read_pose_fields(fields);
  return which == CarmenPose::kLaser ? laser : robot;
}

// FLASER n ranges.. laser-pose robot-pose time host logger-time
StampedPose read_flaser(FieldReader& fields, CarmenPose which) {
  skip_numbers(fields, "number of beams", "range");
  const Pose2 pose = read_either_pose(fields, which);
  return {read_stamp(fields), pose};
}

// ROBOTLASER1 type start fov step max-range accuracy remission-mode n ranges.. m remissions.. laser-pose
// robot-pose tv rv forward-safety side-safety turn-axis time host logger-time
StampedPose read_robotlaser(FieldReader& fields, CarmenPose which) {
  for (int i = 0; i < 7; ++i) fields.maybe_not_finite("laser parameter");
  skip_numbers(fields, "number of beams", "range");
  skip_numbers(fields, "number of remissions", "remission");
  const Pose2 pose = read_either_pose(fields, which);
  for (int i = 0; i < 5; ++i) fields.maybe_not_finite("velocity or safety distance");
  return {read_stamp(fields), pose};
}

}  // namespace

Trajectory read_carmen_trajectory(std::istream& input, const std::string& name, CarmenPose which,
                                  Diagnostics& diagnostics) {
  LineReader lines(input, name);
  PoseCollector poses;
  while (next_data_line(lines)) {
    FieldReader fields(lines);
    const std::string_view message = fields.word("message name");
    if (message != "FLASER" && message != "ROBOTLASER1") continue;
    const auto [stamp, pose] =
        message == "FLASER" ? read_flaser(fields, which) : read_robotlaser(fields, which);
    poses.add(stamp, pose, lines, diagnostics);
  }
  return poses.finish(lines, diagnostics);
}

}  // namespace cairn
