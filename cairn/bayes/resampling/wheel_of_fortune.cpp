#include "cairn/bayes/resampling/wheel_of_fortune.hpp"

#include "cairn/bayes/resampling/ancestor_search.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

double largest_weight(std::span<const double> cumulative) {
  double largest = cumulative[0];
  for (std::size_t i = 1; i < cumulative.size(); ++i)
    largest = std::max(largest, cumulative[i] - cumulative[i - 1]);
  return largest;
}

}  // namespace

void WheelOfFortune::draw(std::span<const double> cumulative, std::size_t count,
                          const DrawingNumbers& numbers, std::vector<std::uint32_t>& ancestors) {
  index(cumulative);
  const double longest_turn = 2.0 * largest_weight(cumulative);
  double position = numbers.start();
  for (std::size_t k = 0; k < count; ++k) {
    position += longest_turn * numbers.of_particle(static_cast<std::uint32_t>(k));
    position -= std::floor(position);
    ancestors.push_back(find(cumulative, position));
  }
}

void WheelOfFortune::index(std::span<const double> cumulative) {
  AncestorSearch search(cumulative);
  entries_.resize(cumulative.size());
  for (std::size_t k = 0; k < entries_.size(); ++k)
    entries_[k] = search.at(static_cast<double>(k) / static_cast<double>(entries_.size()));
}

std::uint32_t WheelOfFortune::find(std::span<const double> cumulative, double position) const {
  position = std::min(position, AncestorSearch::kLargestPosition);
  const auto entry = static_cast<std::size_t>(position * static_cast<double>(entries_.size()));
  std::uint32_t i = entries_[std::min(entry, entries_.size() - 1)];
  while (i > 0 && cumulative[i - 1] > position) --i;  // the product above may have been rounded up
  while (cumulative[i] <= position) ++i;
  return i;
}

}  // namespace cairn
