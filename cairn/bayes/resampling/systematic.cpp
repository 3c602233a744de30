#include "cairn/bayes/resampling/systematic.hpp"

#include "cairn/core/batch_math.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace cairn {
namespace {

constexpr std::size_t kAtOnce = 256;
}  // namespace

void draw_systematic(std::span<const double> cumulative, std::size_t count, double offset,
                     std::vector<std::uint32_t>& ancestors) {
  constexpr std::size_t kUnasked = 4;
  const std::size_t first = ancestors.size();
  ancestors.resize(first + count + kUnasked);
  std::uint32_t* const out = ancestors.data() + first;
  std::array<std::int32_t, kAtOnce> ends;
  std::size_t drawn = 0;
  for (std::size_t begin = 0; begin < cumulative.size(); begin += kAtOnce) {
    const auto block = cumulative.subspan(begin, std::min(kAtOnce, cumulative.size() - begin));
    // Tooth t lies at (t + offset) / count: so many lie below the end of each index.
    ceilings(block, static_cast<double>(count), offset, std::span(ends).first(block.size()));
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
