#pragma once

#include "cairn/io/log.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace cairn {

/// What all scans of a stream have in common, or how far they differ.
struct LaserSummary {
  std::size_t beams_min = 0;
  std::size_t beams_max = 0;
  double first_angle_rad = 0.0;  ///< of the first scan: its first beam
  double last_angle_rad = 0.0;   ///< and its last; less than the first if the beams turn clockwise
  double range_min_m = 0.0;      ///< limits of the first scan
  double range_max_m = 0.0;
  double valid_share = 0.0;  ///< of all readings, 0..1: neither "no return" nor out of limits
};

/// What the messages of any other sensor have in common.
struct SensorSummary {
  std::size_t readings_min = 0;  ///< in one message: transducers, pixels, access points, beacons, landmarks
  std::size_t readings_max = 0;
  /// Of all readings, 0..1: with an echo, with a depth, with a range (beacons), recognised (landmarks).
  double valid_share = 0.0;
};

/// A robot's path is the same in the order of the file and in that of the stamps, unless stamps are wrong:
/// then one of the two, usually the second, is longer, because neighbours were swapped (30 % in the intel
/// log).
struct OdometrySummary {
  double path_length_m = 0.0;           ///< in the order of the file
  double path_length_by_stamp_m = 0.0;  ///< in the order of the stamps
};

struct StreamSummary {
  StreamInfo info;
  std::size_t messages = 0;
  Time first;                      ///< earliest stamp
  Time last;                       ///< latest stamp
  double rate_hz = 0.0;            ///< messages over the span; 0 for a single message
  double median_period_s = 0.0;    ///< between stamps, sorted
  std::size_t gaps = 0;            ///< steps between sorted stamps longer than 5 median periods
  double longest_gap_s = 0.0;      ///< longest step, gap or not
  std::size_t time_reversals = 0;  ///< messages of this stream stamped before their predecessor in the file
  std::optional<LaserSummary> laser;
  std::optional<SensorSummary> sensor;  ///< neither laser nor odometry
  std::optional<OdometrySummary> odometry;
};

/// What a log holds.
struct LogSummary {
  std::string format;
  std::size_t messages = 0;
  Time first;
  Time last;
  std::vector<StreamSummary> streams;  ///< as in the log
  Diagnostics diagnostics;             ///< what the reader counted
};

LogSummary summarize(const Log& log);

/// As JSON, indented: `format, messages, start_s, end_s, span_s, streams: [{name, kind (name_of(
/// StreamKind)), frame, T_base_sensor ({x_m, y_m, theta_rad} | null), messages, start_s, end_s, rate_hz,
/// median_period_s, gaps, longest_gap_s, time_reversals, laser: {...} | odometry: {...} | sensor: {...}}],
/// warnings: [{kind, count, examples: [text]}]`. Keys are the members' names.
std::string to_json(const LogSummary& summary);

}  // namespace cairn
