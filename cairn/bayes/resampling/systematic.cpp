#include "cairn/bayes/resampling/systematic.hpp"

#include "cairn/bayes/resampling/ancestor_search.hpp"

namespace cairn {

void draw_systematic(std::span<const double> cumulative, std::size_t count, double offset,
                     std::vector<std::uint32_t>& ancestors) {
  AncestorSearch search(cumulative);
  for (std::size_t tooth = 0; tooth < count; ++tooth) {
    ancestors.push_back(search.at((static_cast<double>(tooth) + offset) / static_cast<double>(count)));
  }
}

}  // namespace cairn
