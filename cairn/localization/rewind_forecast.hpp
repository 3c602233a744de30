#pragma once

#include "cairn/core/time.hpp"

#include <array>
#include <cstddef>
#include <optional>

namespace cairn {

/// How often what is applied now will be done again, judged by how far the belief went back lately.
///
/// A measurement of age a (behind the newest one that is applied) is done again by every rewind that goes
/// back further than it is old by then. If rewinds of depths d_1, d_2, ... were seen in the last w seconds
/// and go on as they did, that is expected to happen
///
///   redos(a) = sum_i max(0, d_i - a) / w
///
/// times: a stream at 5 Hz that is half a second late has all that is new done again 2.5 times, and what is
/// half a second old never. Does not touch the heap.
class RewindForecast {
 public:
  static constexpr std::size_t kMost = 64;
  static constexpr Duration kWindow = std::chrono::seconds(2);

  /// The belief went back by `depth` at `now`.
  void went_back(Duration depth, Time now);

  /// @param age  negative: not yet reached by the belief, as if it were new
  double redos(Duration age, Time now) const;

  /// The clock was set back: forgets all.
  void clear() { count_ = 0; }

 private:
  struct Rewind {
    Duration depth;
    Time when;
  };
  std::array<Rewind, kMost> seen_{};
  std::size_t next_ = 0;
  std::size_t count_ = 0;
};

}  // namespace cairn
