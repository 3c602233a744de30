#pragma once

#include "cairn/localization/recent_values.hpp"
#include "cairn/sensing/event.hpp"

#include <optional>
#include <vector>

namespace cairn {

/// How long after its measurement each stream's messages arrive (MuSe, section III-D): arrival minus stamp.
/// The two clocks need not have the same zero: what counts are differences between streams, and a common
/// offset cancels. Of each stream the last 31 messages of the last `memory` count, and of those the typical
/// (median) or nearly the largest (95 %): one wrong stamp changes neither, a passing delay is forgotten, and
/// a stream that fell silent holds nobody up.
class LagEstimator {
 public:
  LagEstimator(std::size_t streams, Duration memory);

  /// @param now the arrival of the newest event of any stream
  void observe(StreamId stream, Time stamp, Time arrival, Time now);

  /// Forgets all that was seen.
  void clear();

  /// Median of the stream; nullopt where it said nothing lately.
  std::optional<Duration> typical(StreamId stream, Time now) const;

  /// The smallest typical lag of all streams: how far the newest stamp that can be known is behind `now`.
  std::optional<Duration> shortest(Time now) const;

  /// Nearly the largest lag (95 %) of the most delayed stream: what MuSe delays all streams by.
  std::optional<Duration> longest(Time now) const;

 private:
  std::vector<RecentValues> lags_;
};

}  // namespace cairn
