#include "cairn/localization/estimate.hpp"

#include <numeric>

namespace cairn {

const char* to_string(Outcome outcome) {
  static constexpr std::array<const char*, kOutcomeCount> kNames = {
      "used",
      "replayed",
      "deferred",
      "not_needed",
      "dropped_stale",
      "dropped_over_budget",
      "dropped_duplicate",
      "dropped_out_of_order",
      "dropped_no_odometry",
      "dropped_malformed",
      "dropped_unbound_stream",
      "pending",
  };
  const auto index = static_cast<std::size_t>(outcome);
  return index < kOutcomeCount ? kNames[index] : "unknown";
}

const char* to_string(TrackingState state) {
  static constexpr std::array<const char*, kTrackingStateCount> kNames = {"tracking", "crowded", "ambiguous",
                                                                          "lost", "sensor_fault"};
  const auto index = static_cast<std::size_t>(state);
  return index < kTrackingStateCount ? kNames[index] : "unknown";
}

bool is_use(Outcome outcome) {
  return outcome == Outcome::kUsed || outcome == Outcome::kReplayed || outcome == Outcome::kDeferred;
}

bool is_drop(Outcome outcome) {
  return outcome >= Outcome::kDroppedStale && outcome <= Outcome::kDroppedUnboundStream;
}

double drop_rate(const OutcomeCounts& counts) {
  const std::int64_t received = std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
  std::int64_t dropped = 0;
  for (std::size_t i = 0; i < kOutcomeCount; ++i) {
    if (is_drop(static_cast<Outcome>(i))) dropped += counts[i];
  }
  return received == 0 ? 0.0 : static_cast<double>(dropped) / static_cast<double>(received);
}

}  // namespace cairn
