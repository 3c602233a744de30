#include "cairn/io/log.hpp"

#include <algorithm>

namespace cairn {

std::size_t sort_by_stamp(Log& log) {
  std::size_t reversals = 0;
  for (std::size_t i = 1; i < log.events.size(); ++i) {
    reversals += log.events[i].stamp < log.events[i - 1].stamp ? 1 : 0;
  }
  std::stable_sort(log.events.begin(), log.events.end(),
                   [](const Event& a, const Event& b) { return a.stamp < b.stamp; });
  return reversals;
}

}  // namespace cairn
