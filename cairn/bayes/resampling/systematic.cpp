#include "cairn/bayes/resampling/systematic.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace cairn {
namespace {

constexpr std::size_t kAtOnce = 256;
using Ends = std::array<std::int32_t, kAtOnce>;

// Tooth t lies at (t + offset) / count: so many lie below the end of each index.
void find_ends(std::span<const double> cumulative, double count, double offset, Ends& ends) {
  for (std::size_t i = 0; i < cumulative.size(); ++i) {
    const double teeth = cumulative[i] * count - offset;
    const auto whole = static_cast<std::int32_t>(teeth);
    ends[i] = whole + (static_cast<double>(whole) < teeth ? 1 : 0);
  }
}

}  // namespace

void draw_systematic(std::span<const double> cumulative, std::size_t count, double offset,
                     std::vector<std::uint32_t>& ancestors) {
  constexpr std::size_t kUnasked = 4;
  const std::size_t first = ancestors.size();
  ancestors.resize(first + count + kUnasked);
  std::uint32_t* const out = ancestors.data() + first;
  Ends ends;
  std::size_t drawn = 0;
  for (std::size_t begin = 0; begin < cumulative.size(); begin += kAtOnce) {
    const auto block = cumulative.subspan(begin, std::min(kAtOnce, cumulative.size() - begin));
    find_ends(block, static_cast<double>(count), offset, ends);
    for (std::size_t i = 0; i < block.size(); ++i) {
      const auto index = static_cast<std::uint32_t>(begin + i);
      const auto end = static_cast<std::size_t>(ends[i]);
      // Most indices are drawn less than four times: writing four costs less than guessing how many.
      std::fill_n(out + drawn, kUnasked, index);
      for (std::size_t tooth = drawn + kUnasked; tooth < end; ++tooth) out[tooth] = index;
      drawn = end;
    }
  }
  ancestors.resize(first + count);
}

}  // namespace cairn
