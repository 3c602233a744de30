#pragma once

#include "cairn/core/diagnostics.hpp"
#include "cairn/core/trajectory.hpp"
#include "cairn/io/text_fields.hpp"

namespace cairn {

/// Positions further than this from the origin are refused: they are garbage, not metres (UTM fits).
inline constexpr double kMaxCoordinateM = 1e8;

/// Next line that holds data: blank lines and lines that begin with '#' are passed over.
bool next_data_line(LineReader& lines);

/// Stamp in seconds.
/// @throws InputError for one more than 145 years from zero, so that differences of stamps never overflow
Time read_stamp(FieldReader& fields, const char* meaning = "stamp");

/// One coordinate in metres.
/// @throws InputError for one beyond kMaxCoordinateM, and as FieldReader
double read_coordinate(FieldReader& fields, const char* meaning);

/// Fields `x y theta` (m, m, rad; any finite angle, brought to [-pi, pi)).
/// @throws InputError as read_coordinate
Pose2 read_pose_fields(FieldReader& fields);

/// @throws InputError naming the column if the line holds more fields
void expect_line_end(FieldReader& fields);

/// Gathers the poses of a file and puts them in order at the end.
class PoseCollector {
 public:
  void add(Time stamp, const Pose2& pose, const LineReader& line, Diagnostics& diagnostics);

  /// The poses by stamp. Counts in `diagnostics`: "stamp runs backwards" (sorted), "duplicate stamp" (the
  /// first one is kept), "last line has no end" (the file may have been cut short) and "implausible units"
  /// (centimetres read as metres: see SpeedMeter).
  /// @throws InputError if there is no pose at all
  Trajectory finish(const LineReader& lines, Diagnostics& diagnostics);

 private:
  Trajectory poses_;
};

}  // namespace cairn
