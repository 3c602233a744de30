#include "cairn/localization/lag_estimator.hpp"

#include <algorithm>

namespace cairn {
namespace {

constexpr double kNearlyAll = 0.95;

}  // namespace

LagEstimator::LagEstimator(std::size_t streams, Duration memory) : lags_(streams, RecentValues(memory)) {}

void LagEstimator::observe(StreamId stream, Time stamp, Time arrival, Time now) {
  lags_[stream].add(arrival - stamp, now);
}

void LagEstimator::clear() {
  for (RecentValues& lags : lags_) lags.clear();
}

std::optional<Duration> LagEstimator::typical(StreamId stream, Time now) const {
  return lags_[stream].quantile(0.5, now);
}

std::optional<Duration> LagEstimator::shortest(Time now) const {
  std::optional<Duration> shortest;
  for (const RecentValues& lags : lags_) {
    const auto lag = lags.quantile(0.5, now);
    if (lag && (!shortest || *lag < *shortest)) shortest = lag;
  }
  return shortest;
}

std::optional<Duration> LagEstimator::longest(Time now) const {
  std::optional<Duration> longest;
  for (const RecentValues& lags : lags_) {
    const auto lag = lags.quantile(kNearlyAll, now);
    if (lag && (!longest || *lag > *longest)) longest = lag;
  }
  return longest;
}

}  // namespace cairn
