#pragma once

#include "cairn/core/errors.hpp"
#include "cairn/io/log.hpp"
#include "cairn/io/text_fields.hpp"

#include <cstddef>
#include <functional>
#include <istream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cairn {

/// Nearest range that the scanners of the old text logs tell: below it lies "no return" (a reading of zero).
inline constexpr double kTextLogRangeMinM = 0.01;
/// Maximum range where a text log tells none. SICK LMS scanners give 81.83 to 81.91 m for "no return".
inline constexpr double kTextLogRangeMaxM = 80.0;

/// Collects what the messages of a text log say. A reader checks a message completely before it adds
/// anything.
class TextLogBuilder {
 public:
  explicit TextLogBuilder(const LineReader& line) : line_(line) {}

  /// The stream of this name, made when it is first asked for.
  StreamId stream(const std::string& name, StreamKind kind);

  void add_odometry(StreamId stream, Time stamp, Time arrival, const Pose2& T_odom_base);
  /// `scan->range_max_m == 0`: not told by the message. Then finish() sets it, see read_text_log.
  void add_scan(StreamId stream, Time arrival, std::shared_ptr<LaserScan> scan);

  void add_beacons(StreamId stream, BeaconRanges ranges);

  /// Mounting pose as one message implies it. Kept if all messages of the stream agree within 5 cm and 3
  /// degrees.
  void observe_mount(StreamId stream, const Pose2& T_base_sensor);

  /// Counts something about the current line.
  void warn(const std::string& kind, const std::string& what);
  void warn(const std::string& kind, const InputError& error);

  const std::vector<Event>& events() const { return log_.events; }
  Log finish();

 private:
  struct StreamState {
    std::vector<std::shared_ptr<LaserScan>> scans_without_limit;
    bool mount_is_doubtful = false;
  };

  void add(Event event);
  void set_range_limit(StreamId stream);

  const LineReader& line_;
  Log log_;
  std::map<std::string, StreamId> stream_ids_;
  std::vector<StreamState> states_;
};

/// Reads one message; throws InputError if it is malformed, before it has added anything.
using ReadMessage = std::function<void(FieldReader& fields, TextLogBuilder& builder)>;

/// Reads a log of one message a line; blank lines and lines that start with '#' are skipped.
///
/// A malformed line is skipped and counted ("malformed line"; "truncated line" if it is the last one and has
/// no line end). Stamps that run backwards are counted ("time reversal") and kept. Scans whose message tells
/// no maximum range get the mark for "no return" that their readings show (less 0.1 m, counted as "range
/// limit inferred"; see no_return_mark.hpp), else kTextLogRangeMaxM. Numbers that cannot be metres are
/// counted (plausible_units.hpp).
/// @throws InputError if no usable message is left, or more than half of the lines are malformed.
Log read_text_log(std::istream& input, const std::string& name, const std::string& format,
                  const ReadMessage& read);

/// Pose "x y theta" as three fields, scaled to metres. Malformed if not finite or farther than 10,000 km from
/// zero.
Pose2 read_pose(FieldReader& fields, double metres_per_unit = 1.0);

/// `count` ranges, scaled to metres. NaN and infinity are kept (no return); a negative range is malformed. A
/// count beyond the line's fields is malformed and allocates nothing of that size.
std::vector<float> read_ranges(FieldReader& fields, long long count, double metres_per_unit = 1.0);

}  // namespace cairn
