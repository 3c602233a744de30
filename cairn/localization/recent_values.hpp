#pragma once

#include "cairn/core/time.hpp"

#include <array>
#include <cstddef>
#include <optional>

namespace cairn {

/// The last few durations that were seen, and any quantile of them. A few wild values do not move the median,
/// and none counts for longer than `lifetime`: robust, with decay. Does not touch the heap.
class RecentValues {
 public:
  static constexpr std::size_t kMost = 31;

  explicit RecentValues(Duration lifetime) : lifetime_(lifetime) {}

  /// Takes a value that was seen at `now`.
  void add(Duration value, Time now);

  /// The smallest value that at least the share `q` of those not older than the lifetime does not exceed;
  /// nullopt if there is none. @param q 0 (the smallest) to 1 (the largest)
  std::optional<Duration> quantile(double q, Time now) const;

  void clear() { count_ = 0; }

 private:
  struct Seen {
    Duration value;
    Time when;
  };
  Duration lifetime_;
  std::array<Seen, kMost> seen_{};
  std::size_t next_ = 0;
  std::size_t count_ = 0;
};

}  // namespace cairn
