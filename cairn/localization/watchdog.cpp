#include "cairn/localization/watchdog.hpp"

#include <algorithm>
#include <utility>

namespace cairn {
namespace {

constexpr double kLongest_s = 1e6;
// Messages that come in bursts have a median gap of nothing: nine in ten gaps tell the rhythm, and up to
// three silences among the last 31 gaps do not change it.
constexpr double kUsualShare = 0.9;

}  // namespace

Watchdog::Watchdog(std::vector<std::optional<Duration>> periods, double factor)
    : streams_(periods.size()), factor_(factor) {
  for (std::size_t i = 0; i < periods.size(); ++i) streams_[i].told = periods[i];
}

void Watchdog::heard(StreamId id, Time now) {
  Stream& stream = streams_[id];
  if (stream.last) stream.gaps.add(std::max(now - *stream.last, Duration{0}), now);
  stream.last = now;
  stream.silent = false;
  stream.period = stream.told ? stream.told : stream.gaps.quantile(kUsualShare, now);
  set_deadline(stream);
}

void Watchdog::set_deadline(Stream& stream) {
  if (factor_ <= 0.0 || !stream.period || stream.period->count() == 0) return;
  const double wait_s = std::min(factor_ * to_seconds(*stream.period), kLongest_s);
  stream.deadline = *stream.last + duration_from_seconds(wait_s);
  next_look_ = std::min(next_look_, *stream.deadline);
}

void Watchdog::restart(Time now) {
  next_look_ = Time::max();
  for (Stream& stream : streams_) {
    if (!stream.last) continue;
    stream.last = now;
    set_deadline(stream);
  }
}

}  // namespace cairn
