#include "cairn/localization/recent_values.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {

void RecentValues::add(Duration value, Time now) {
  seen_[next_] = {value, now};
  next_ = (next_ + 1) % kMost;
  count_ = std::min(count_ + 1, kMost);
}

std::optional<Duration> RecentValues::quantile(double q, Time now) const {
  std::array<Duration, kMost> values;
  std::size_t n = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    if (now - seen_[i].when <= lifetime_) values[n++] = seen_[i].value;
  }
  if (n == 0) return std::nullopt;
  const auto rank = static_cast<std::size_t>(std::ceil(q * static_cast<double>(n)));
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(std::clamp<std::size_t>(rank, 1, n) - 1);
  std::nth_element(values.begin(), place, values.begin() + static_cast<std::ptrdiff_t>(n));
  return *place;
}

}  // namespace cairn
