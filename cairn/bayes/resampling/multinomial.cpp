#include "cairn/bayes/resampling/multinomial.hpp"

#include "cairn/bayes/resampling/ancestor_search.hpp"
#include "cairn/bayes/resampling/ascending_uniforms.hpp"

namespace cairn {

void Multinomial::draw(std::span<const double> cumulative, std::size_t count, const DrawingNumbers& numbers,
                       std::vector<std::uint32_t>& ancestors) {
  AncestorSearch search(cumulative);
  AscendingUniforms positions(count, numbers);
  for (std::size_t k = 0; k < count; ++k) ancestors.push_back(search.at(positions.next()));
}

}  // namespace cairn
