#include "cairn/bayes/resampling/systematic.hpp"

namespace cairn {

void draw_systematic(std::span<const double> cumulative, std::size_t count, double offset,
                     std::vector<std::uint32_t>& ancestors) {
  const std::size_t last = cumulative.size() - 1;
  std::size_t i = 0;
  for (std::size_t tooth = 0; tooth < count; ++tooth) {
    const double position = (static_cast<double>(tooth) + offset) / static_cast<double>(count);
    while (i < last && cumulative[i] <= position) ++i;
    ancestors.push_back(static_cast<std::uint32_t>(i));
  }
}

}  // namespace cairn
