#pragma once

#include "cairn/sensing/event.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace cairn {

/// What each scanner of a robot last made of its pose (decision 103). One that sees what the map leads to
/// expect vouches for the pose; one among people says little against any place, and does not.
class Witnesses {
 public:
  static constexpr double kExpected = 0.6;  ///< explained share of the beams that vouches
  static constexpr int kStillHeard = 8;     ///< measurements of all streams after which one counts no more

  explicit Witnesses(std::size_t streams = 0) : last_(streams) {}

  /// Any stream has measured something.
  void pass();
  /// It was a scanner, and this is what it makes of the pose.
  /// @param evidence for the pose, log-odds
  /// @param explained share of its beams that the map explains there
  void hear(StreamId stream, double evidence, double explained);

  /// Whether another scanner vouches for the pose.
  bool vouched(StreamId stream) const;
  /// Whether no other scanner is heard.
  bool alone(StreamId stream) const;

 private:
  struct Testimony {
    bool in_favour;
    int age = 0;
  };
  std::vector<std::optional<Testimony>> last_;  ///< per stream
};

}  // namespace cairn
