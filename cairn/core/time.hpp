#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cairn {

/// Clock of the measurements: nanoseconds since the log's own epoch. It has no now(): the library never asks
/// what time it is, so that a replay gives the same bytes.
struct SensorClock {
  using duration = std::chrono::nanoseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<SensorClock>;
  static constexpr bool is_steady = true;
};

using Duration = SensorClock::duration;
using Time = SensorClock::time_point;

/// Nearest nanosecond. `seconds` must be finite and within +-9.2e9 (292 years).
Time time_from_seconds(double seconds);
Duration duration_from_seconds(double seconds);

double to_seconds(Time time);
double to_seconds(Duration duration);

/// "976052857.337530" -> exact nanoseconds, without passing through a double (digits beyond nine are cut).
/// Accepts a sign and an exponent-free decimal; nullopt for anything else or beyond +-292 years.
std::optional<Time> parse_time(std::string_view text);

/// Seconds with nine decimals: the inverse of parse_time.
std::string format_time(Time time);

}  // namespace cairn
