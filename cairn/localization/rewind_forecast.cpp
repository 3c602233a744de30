#include "cairn/localization/rewind_forecast.hpp"

#include <algorithm>

namespace cairn {

void RewindForecast::went_back(Duration depth, Time now) {
  seen_[next_] = {depth, now};
  next_ = (next_ + 1) % kMost;
  count_ = std::min(count_ + 1, kMost);
}

// Where more were seen than there is room for, the window is as long as what there is room for.
double RewindForecast::redos(Duration age, Time now) const {
  const Duration at_least = std::max(age, Duration{0});
  Duration window = kWindow, sum{0};
  for (std::size_t i = 0; i < count_; ++i) {
    if (now - seen_[i].when > kWindow) continue;
    sum += std::max(seen_[i].depth - at_least, Duration{0});
  }
  if (count_ == kMost) window = std::clamp(now - seen_[next_].when, Duration{1}, kWindow);
  return static_cast<double>(sum.count()) / static_cast<double>(window.count());
}

}  // namespace cairn
