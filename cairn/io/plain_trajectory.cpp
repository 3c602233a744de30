#include "cairn/io/plain_trajectory.hpp"

#include "cairn/io/pose_collector.hpp"

#include <string>

namespace cairn {
namespace {

constexpr int kCovarianceEntries = 9;

void check_covariance(FieldReader& fields) {
  if (fields.at_end()) return;
  for (int i = 0; i < kCovarianceEntries; ++i) fields.number("covariance entry");
}

Time stamp_of_frame(FieldReader& fields, std::span<const Time> frame_stamps, int offset) {
  const long long row = fields.integer("pose number");
  const auto frames = static_cast<long long>(frame_stamps.size());
  if (row < -offset || row >= frames - offset) {
    fields.fail("pose " + std::to_string(row) + " belongs to no frame of the log, which has " +
                    std::to_string(frames),
                "check that path and log belong together");
  }
  return frame_stamps[static_cast<std::size_t>(row + offset)];
}

}  // namespace

Trajectory read_plain_trajectory(std::istream& input, const std::string& name, Diagnostics& diagnostics) {
  LineReader lines(input, name);
  PoseCollector poses;
  while (next_data_line(lines)) {
    FieldReader fields(lines);
    const Time stamp = read_stamp(fields);
    const Pose2 pose = read_pose_fields(fields);
    expect_line_end(fields);
    poses.add(stamp, pose, lines, diagnostics);
  }
  return poses.finish(lines, diagnostics);
}

Trajectory read_rawseeds_trajectory(std::istream& input, const std::string& name, Diagnostics& diagnostics) {
  LineReader lines(input, name);
  PoseCollector poses;
  while (next_data_line(lines)) {
    FieldReader fields(lines, " \t,");
    const Time stamp = read_stamp(fields);
    const Pose2 pose = read_pose_fields(fields);
    check_covariance(fields);
    expect_line_end(fields);
    poses.add(stamp, pose, lines, diagnostics);
  }
  return poses.finish(lines, diagnostics);
}

Trajectory read_indexed_trajectory(std::istream& input, const std::string& name,
                                   std::span<const Time> frame_stamps, int offset, Diagnostics& diagnostics) {
  LineReader lines(input, name);
  PoseCollector poses;
  while (next_data_line(lines)) {
    FieldReader fields(lines);
    const Time stamp = stamp_of_frame(fields, frame_stamps, offset);
    const Pose2 pose = read_pose_fields(fields);
    expect_line_end(fields);
    poses.add(stamp, pose, lines, diagnostics);
  }
  return poses.finish(lines, diagnostics);
}

bool is_indexed_trajectory(std::istream& input) {
  LineReader lines(input, "");
  int row = 0;
  while (next_data_line(lines)) {
    FieldReader fields(lines);
    if (fields.word("pose number") != std::to_string(row)) return false;
    ++row;
  }
  return row > 1;
}

}  // namespace cairn
