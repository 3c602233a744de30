#include "cairn/io/text_log.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/io/no_return_mark.hpp"
#include "cairn/io/plausible_units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cairn {
namespace {

constexpr double kFarthestM = 1e7;
constexpr double kMarkMarginM = 0.1;
constexpr double kMountToleranceM = 0.05;
const double kMountToleranceRad = degrees_to_radians(3.0);
constexpr std::size_t kMostReserved = 4096;
// So many malformed lines are enough to judge: a large file that is no log at all ends early.
constexpr std::size_t kEnoughToJudge = 10000;

bool same_mount(const Pose2& a, const Pose2& b) {
  return distance(a, b) < kMountToleranceM &&
         std::abs(angle_difference(a.theta, b.theta)) < kMountToleranceRad;
}

/// Counts lines, and decides whether what was read is worth keeping.
class LineTally {
 public:
  LineTally(std::string name, std::string format) : name_(std::move(name)), format_(std::move(format)) {}

  void count_line() { ++lines_; }
  void count_malformed(const InputError& error) {
    if (++malformed_ == 1) first_ = error.what();
    if (malformed_ % kEnoughToJudge == 0) check_share();
  }
  void check_share() const {
    if (2 * malformed_ <= lines_) return;
    throw InputError(name_,
                     std::to_string(malformed_) + " of " + std::to_string(lines_) + " lines are malformed",
                     "check that it is a " + format_ + " log; the first: " + first_);
  }
  void check_any(bool any) const {
    if (any) return;
    throw InputError(
        name_, "no usable message in " + std::to_string(lines_) + " lines",
        "check that it is a " + format_ + " log" + (malformed_ > 0 ? "; the first: " + first_ : ""));
  }

 private:
  std::string name_;
  std::string format_;
  std::size_t lines_ = 0;
  std::size_t malformed_ = 0;
  std::string first_;
};

}  // namespace

StreamId TextLogBuilder::stream(const std::string& name, StreamKind kind) {
  const auto [entry, is_new] = stream_ids_.try_emplace(name, static_cast<StreamId>(log_.streams.size()));
  if (is_new) {
    log_.streams.push_back({name, kind, "", std::nullopt});
    states_.emplace_back();
  }
  return entry->second;
}

void TextLogBuilder::add(Event event) {
  if (!log_.events.empty() && event.stamp < log_.events.back().stamp) {
    const Time before = log_.events.back().stamp;
    warn("time reversal", "stamp " + format_time(event.stamp) + " is " +
                              std::to_string(to_seconds(before - event.stamp)) +
                              " s earlier than the one before it");
  }
  log_.events.push_back(std::move(event));
}

void TextLogBuilder::add_beacons(StreamId stream, BeaconRanges ranges) {
  const Time stamp = ranges.stamp;
  add({stamp, stamp, stream, std::make_shared<const BeaconRanges>(std::move(ranges))});
}

void TextLogBuilder::add_odometry(StreamId stream, Time stamp, Time arrival, const Pose2& T_odom_base) {
  add({stamp, arrival, stream, Odometry{stamp, T_odom_base}});
}

void TextLogBuilder::add_scan(StreamId stream, Time arrival, std::shared_ptr<LaserScan> scan) {
  if (scan->range_max_m == 0.0) states_[stream].scans_without_limit.push_back(scan);
  const Time stamp = scan->stamp;
  add({stamp, arrival, stream, std::move(scan)});
}

void TextLogBuilder::observe_mount(StreamId stream, const Pose2& T_base_sensor) {
  StreamState& state = states_[stream];
  std::optional<Pose2>& mount = log_.streams[stream].T_base_sensor;
  if (state.mount_is_doubtful) return;
  if (!mount) {
    mount = T_base_sensor;
  } else if (!same_mount(*mount, T_base_sensor)) {
    state.mount_is_doubtful = true;
    mount.reset();
    warn("mount unknown",
         "the poses of laser and robot do not keep their distance: they are in different frames");
  }
}

void TextLogBuilder::warn(const std::string& kind, const std::string& what) {
  log_.diagnostics.warn(kind, line_.where(), what);
}

void TextLogBuilder::warn(const std::string& kind, const InputError& error) {
  const std::string text = error.what();
  log_.diagnostics.warn(kind, error.where(), text.substr(error.where().size() + 2));
}

void TextLogBuilder::set_range_limit(StreamId stream) {
  const auto& scans = states_[stream].scans_without_limit;
  if (scans.empty()) return;
  const auto mark = find_no_return_mark(scans, kTextLogRangeMaxM);
  if (mark) {
    log_.diagnostics.warn("range limit inferred", line_.name() + ", stream " + log_.streams[stream].name,
                          "readings of " + std::to_string(*mark) + " m stand out: taken as no return");
  }
  for (const auto& scan : scans) scan->range_max_m = mark ? *mark - kMarkMarginM : kTextLogRangeMaxM;
}

Log TextLogBuilder::finish() {
  for (std::size_t i = 0; i < states_.size(); ++i) set_range_limit(static_cast<StreamId>(i));
  warn_of_implausible_units(log_, line_.name());
  return std::move(log_);
}

Log read_text_log(std::istream& input, const std::string& name, const std::string& format,
                  const ReadMessage& read) {
  LineReader line(input, name);
  TextLogBuilder builder(line);
  LineTally tally(name, format);
  while (line.next()) {
    FieldReader fields(line);
    if (fields.at_end() || line.line().starts_with('#')) continue;
    tally.count_line();
    try {
      read(fields, builder);
    } catch (const InputError& error) {
      builder.warn(line.line_was_ended() ? "malformed line" : "truncated line", error);
      tally.count_malformed(error);
    }
  }
  tally.check_any(!builder.events().empty());
  tally.check_share();
  Log log = builder.finish();
  log.format = format;
  return log;
}

Pose2 read_pose(FieldReader& fields, double metres_per_unit) {
  Pose2 pose;
  pose.x = fields.number("x") * metres_per_unit;
  pose.y = fields.number("y") * metres_per_unit;
  if (std::max(std::abs(pose.x), std::abs(pose.y)) > kFarthestM) {
    fields.fail("position farther than 10,000 km from zero", "check the value");
  }
  pose.theta = normalize_angle(fields.number("heading"));
  return pose;
}

std::vector<float> read_ranges(FieldReader& fields, long long count, double metres_per_unit) {
  constexpr double kLargestFloat = std::numeric_limits<float>::max();
  std::vector<float> ranges;
  ranges.reserve(std::min(static_cast<std::size_t>(count), kMostReserved));
  for (long long i = 0; i < count; ++i) {
    const double range = fields.maybe_not_finite("range") * metres_per_unit;
    if (range < 0.0) fields.fail("negative range", "a range is zero or more");
    ranges.push_back(range > kLargestFloat ? std::numeric_limits<float>::infinity()
                                           : static_cast<float>(range));
  }
  return ranges;
}

}  // namespace cairn
