#include "cairn/bayes/resampling/stratified.hpp"

#include "cairn/bayes/resampling/ancestor_search.hpp"

namespace cairn {

void Stratified::draw(std::span<const double> cumulative, std::size_t count, const DrawingNumbers& numbers,
                      std::vector<std::uint32_t>& ancestors) {
  AncestorSearch search(cumulative);
  for (std::size_t k = 0; k < count; ++k) {
    const double within = numbers.of_particle(static_cast<std::uint32_t>(k));
    ancestors.push_back(search.at((static_cast<double>(k) + within) / static_cast<double>(count)));
  }
}

}  // namespace cairn
