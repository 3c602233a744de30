#pragma once

#include "cairn/core/trajectory.hpp"
#include "cairn/io/log.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cairn {

/// Speed of something that moves, over windows of at least a second each: real logs hold bursts of messages
/// that are stamped within a millisecond.
class SpeedMeter {
 public:
  void add(Time stamp, const Pose2& pose);

  /// True for a median above 10 m/s over the windows in which it moves (at least ten).
  bool implausibly_fast() const;

 private:
  std::optional<Pose2> last_;
  std::vector<double> speeds_mps_;
  Time since_;
  double moved_m_ = 0.0;
};

/// True if no robot drives along this path in metres and seconds, as SpeedMeter tells.
bool implausibly_fast(const Trajectory& path);

/// Counts a warning "implausible units" per stream whose numbers cannot be metres and seconds: more than half
/// of the finite, positive ranges beyond 100 m, or a median speed above 10 m/s over the seconds in which the
/// robot moves (at least ten). Centimetres read as metres look like this. The log stays as it is.
/// @param name  of the file, for the messages
void warn_of_implausible_units(Log& log, const std::string& name);

}  // namespace cairn
