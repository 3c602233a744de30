#include "cairn/bayes/resampling/residual.hpp"

#include "cairn/bayes/resampling/ancestor_search.hpp"
#include "cairn/bayes/resampling/ascending_uniforms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn {
namespace {

// Weights come as differences of sums: what should be a whole number may be a little less.
constexpr double kRounding = 1e-7;

struct Share {
  std::size_t certain;  ///< copies
  double fraction;      ///< of a copy, left to chance
};

Share share_of(std::span<const double> cumulative, std::size_t i, std::size_t count) {
  const double weight = cumulative[i] - (i == 0 ? 0.0 : cumulative[i - 1]);
  const double expected = static_cast<double>(count) * weight;
  const double certain = std::floor(expected + kRounding);
  return {static_cast<std::size_t>(certain), std::max(0.0, expected - certain)};
}

}  // namespace

void Residual::draw(std::span<const double> cumulative, std::size_t count, const DrawingNumbers& numbers,
                    std::vector<std::uint32_t>& ancestors) {
  std::size_t to_chance = count;
  double fractions = 0.0;
  for (std::size_t i = 0; i < cumulative.size(); ++i) {
    const Share share = share_of(cumulative, i, count);
    to_chance -= share.certain;
    fractions += share.fraction;
  }
  AscendingUniforms uniforms(to_chance, numbers);
  const auto next_position = [&] {
    return to_chance-- > 0 ? std::min(uniforms.next(), AncestorSearch::kLargestPosition) * fractions
                           : std::numeric_limits<double>::infinity();
  };
  double position = next_position(), passed = 0.0;
  for (std::size_t i = 0; i < cumulative.size(); ++i) {
    const Share share = share_of(cumulative, i, count);
    ancestors.insert(ancestors.end(), share.certain, static_cast<std::uint32_t>(i));
    passed += share.fraction;
    for (; position < passed; position = next_position()) ancestors.push_back(static_cast<std::uint32_t>(i));
  }
}

}  // namespace cairn
