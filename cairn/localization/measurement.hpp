#pragma once

#include "cairn/sensing/event.hpp"

#include <cstdint>

namespace cairn {

/// A measurement on its way into the belief.
struct Measurement {
  Event event;
  std::uint64_t number = 0;  ///< of the event, counted from 1 by arrival
  bool deferred = false;     ///< it had to wait for computing time
  bool came_late = false;    ///< the belief had passed its stamp when it came
};

/// Where a measurement belongs: the order in which measurements enter the belief, however they arrive.
struct TimelineKey {
  Time stamp;
  StreamId stream = 0;

  friend bool operator==(const TimelineKey&, const TimelineKey&) = default;
  friend bool operator<(const TimelineKey& a, const TimelineKey& b) {
    return a.stamp != b.stamp ? a.stamp < b.stamp : a.stream < b.stream;
  }
};

inline TimelineKey key_of(const Measurement& m) { return {m.event.stamp, m.event.stream}; }

}  // namespace cairn
