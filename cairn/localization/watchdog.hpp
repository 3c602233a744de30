#pragma once

#include "cairn/localization/recent_values.hpp"
#include "cairn/sensing/event.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace cairn {

/// Notices streams that fell silent: nothing has arrived for `factor` times the period in which they usually
/// speak. The period is the one that was told, else the gap that nine in ten of the last 31 gaps between
/// arrivals do not exceed: logs and networks deliver in bursts.
class Watchdog {
 public:
  /// @param periods per stream, the period where it is known beforehand
  /// @param factor  at least 1; 0: never complains
  Watchdog(std::vector<std::optional<Duration>> periods, double factor);

  /// A message of `stream` arrived.
  void heard(StreamId stream, Time now);

  /// Looks at all streams. Calls `silent(stream, since, period)` once per silence.
  template <class Silent>
  void look(Time now, const Silent& silent) {
    if (now < next_look_) return;
    next_look_ = Time::max();
    for (std::size_t i = 0; i < streams_.size(); ++i) {
      Stream& stream = streams_[i];
      if (!stream.deadline || stream.silent) continue;
      if (*stream.deadline < now) {
        stream.silent = true;
        silent(static_cast<StreamId>(i), *stream.last, *stream.period);
      } else {
        next_look_ = std::min(next_look_, *stream.deadline);
      }
    }
  }

  bool is_silent(StreamId stream) const { return streams_[stream].silent; }

  /// The clock of the arrivals was set back: silences are counted from `now`.
  void restart(Time now);

 private:
  struct Stream {
    std::optional<Duration> told;
    RecentValues gaps{Duration::max()};
    std::optional<Duration> period;
    std::optional<Time> last;
    std::optional<Time> deadline;
    bool silent = false;
  };

  void set_deadline(Stream& stream);

  std::vector<Stream> streams_;
  double factor_;
  Time next_look_ = Time::max();
};

}  // namespace cairn
