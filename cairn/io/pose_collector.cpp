#include "cairn/io/pose_collector.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/plausible_units.hpp"

#include <cmath>
#include <limits>

namespace cairn {
Time read_stamp(FieldReader& fields, const char* meaning) {
  constexpr Time kLatest{std::chrono::nanoseconds(std::numeric_limits<std::int64_t>::max() / 2)};
  constexpr Time kEarliest{-kLatest.time_since_epoch()};
  const Time stamp = fields.time(meaning);
  if (stamp > kLatest || stamp < kEarliest) {
    fields.fail(std::string(meaning) + " is more than 145 years from zero", "give seconds");
  }
  return stamp;
}

double read_coordinate(FieldReader& fields, const char* meaning) {
  const double value = fields.number(meaning);
  if (std::abs(value) > kMaxCoordinateM) {
    fields.fail(std::string(meaning) + " is more than 100000 km", "give metres");
  }
  return value;
}

bool next_data_line(LineReader& lines) {
  while (lines.next()) {
    const std::size_t first = lines.line().find_first_not_of(" \t");
    if (first != std::string_view::npos && lines.line()[first] != '#') return true;
  }
  return false;
}

Pose2 read_pose_fields(FieldReader& fields) {
  Pose2 pose;
  pose.x = read_coordinate(fields, "x");
  pose.y = read_coordinate(fields, "y");
  pose.theta = normalize_angle(fields.number("theta"));
  return pose;
}

void expect_line_end(FieldReader& fields) {
  if (fields.at_end()) return;
  const std::size_t surplus = fields.fields_left();
  fields.word("surplus field");
  fields.fail("the line has " + std::to_string(surplus) + " fields too many", "check the format of the file");
}

void PoseCollector::add(Time stamp, const Pose2& pose, const LineReader& line, Diagnostics& diagnostics) {
  if (!poses_.empty() && stamp < poses_.back().stamp) {
    diagnostics.warn("stamp runs backwards", line.where(),
                     format_time(stamp) + " s follows " + format_time(poses_.back().stamp) + " s");
  }
  poses_.push_back({stamp, pose});
}

Trajectory PoseCollector::finish(const LineReader& lines, Diagnostics& diagnostics) {
  if (poses_.empty()) throw InputError(lines.name(), "holds no pose", "check that it is the right file");
  if (!lines.line_was_ended()) {
    diagnostics.warn("last line has no end", lines.where(), "the file may have been cut short");
  }
  const std::size_t dropped = sort_by_stamp(poses_);
  if (dropped > 0) diagnostics.count("duplicate stamp", dropped);
  if (implausibly_fast(poses_)) {
    diagnostics.warn("implausible units", lines.name(),
                     "it moves faster than 10 m/s; metres and seconds are expected");
  }
  return std::move(poses_);
}

}  // namespace cairn
