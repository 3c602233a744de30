#include "cairn/localization/synchronizer.hpp"

#include <algorithm>

namespace cairn {

Synchronizer::Synchronizer(const TimeOptions& options, std::size_t streams)
    : delays_(options.late_policy == "delay"),
      odometry_timeout_(duration_from_seconds(options.odometry_timeout_s)),
      lags_(streams, duration_from_seconds(options.lag_memory_s)) {}

void Synchronizer::observe(const Event& event, Time now) {
  now_ = now;
  if (!heard_odometry_) heard_odometry_ = now;
  ++others_;
  lags_.observe(event.stream, event.stamp, event.arrival, now);
}

OdometryTrack::Intake Synchronizer::add(const Odometry& odometry, Time now) {
  heard_odometry_ = now;
  others_ = 0;
  return odometry_.offer(odometry);
}

std::size_t Synchronizer::place_of(const TimelineKey& key) const {
  if (waiting_.empty() || key_of(waiting_.back()) < key) return waiting_.size();
  const auto found =
      std::lower_bound(waiting_.begin(), waiting_.end(), key,
                       [](const Measurement& m, const TimelineKey& k) { return key_of(m) < k; });
  return static_cast<std::size_t>(found - waiting_.begin());
}

void Synchronizer::add(Measurement measurement) {
  const std::size_t place = place_of(key_of(measurement));
  waiting_.insert(place, std::move(measurement));
}

bool Synchronizer::waits(const TimelineKey& key) const {
  const std::size_t place = place_of(key);
  return place < waiting_.size() && key_of(waiting_[place]) == key;
}

bool Synchronizer::odometry_is_silent() const {
  if (ended_) return true;
  return heard_odometry_ && now_ - *heard_odometry_ > odometry_timeout_ && others_ >= kSilentAfter;
}

Time Synchronizer::ready_until() const {
  Time until = odometry_.empty() ? Time::min() : odometry_.newest().stamp;
  if (ended_ && !odometry_.empty()) return until + kExtrapolation;
  if (odometry_is_silent()) {
    if (const auto now = present()) until = std::max(until, *now);
  }
  if (delays_ && !ended_) {
    if (const auto lag = lags_.longest(now_)) until = std::min(until, now_ - *lag);
  }
  return until;
}

// The newest odometry that is believed, and the time that went by since.
std::optional<Time> Synchronizer::present() const {
  if (!odometry_.empty()) return odometry_.newest().stamp + (now_ - *heard_odometry_);
  const auto lag = lags_.shortest(now_);
  return lag ? std::optional(now_ - *lag) : std::nullopt;
}

std::size_t Synchronizer::ready() const {
  if (waiting_.empty()) return 0;
  const auto later = std::upper_bound(waiting_.begin(), waiting_.end(), ready_until(),
                                      [](Time t, const Measurement& m) { return t < m.event.stamp; });
  return static_cast<std::size_t>(later - waiting_.begin());
}

Measurement Synchronizer::remove(std::size_t index) {
  Measurement removed = std::move(waiting_[index]);
  waiting_.erase(index);
  return removed;
}

void Synchronizer::restart_clock(Time now) {
  now_ = now;
  heard_odometry_ = now;
  others_ = 0;
  lags_.clear();
}

}  // namespace cairn
