#include "cairn/bayes/resampling/systematic.hpp"

#include <algorithm>
#include <cstdint>

namespace cairn {

void draw_systematic(std::span<const double> cumulative, std::size_t count, double offset,
                     std::vector<std::uint32_t>& ancestors) {
  constexpr std::size_t kUnasked = 4;
  const std::size_t first = ancestors.size();
  ancestors.resize(first + count + kUnasked);
  std::uint32_t* const out = ancestors.data() + first;
  std::size_t drawn = 0;
  for (std::size_t i = 0; drawn < count; ++i) {
    // Tooth t lies at (t + offset) / count: so many lie below the end of this index.
    const double teeth = cumulative[i] * static_cast<double>(count) - offset;
    const auto whole = static_cast<std::int64_t>(teeth);
    const auto below = static_cast<std::size_t>(whole + (static_cast<double>(whole) < teeth ? 1 : 0));
    const std::size_t end = std::min(below, count);
    // Most indices are drawn less than four times: writing four costs less than guessing how many.
    std::fill_n(out + drawn, kUnasked, static_cast<std::uint32_t>(i));
    for (std::size_t tooth = drawn + kUnasked; tooth < end; ++tooth)
      out[tooth] = static_cast<std::uint32_t>(i);
    drawn = end;
  }
  ancestors.resize(first + count);
}

}  // namespace cairn
