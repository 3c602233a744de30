#include "cairn/bayes/resampling/cumulative_weights.hpp"

#include "cairn/core/batch_math.hpp"
#include "cairn/core/errors.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace cairn {
namespace {

// Turns weights into their cumulative sums. Each addition waits for the one before; hence four parts are
// summed side by side, and each is raised by those before it in the end.
void sum_up(std::span<double> c) {
  constexpr std::size_t kParts = 4;
  const std::size_t length = c.size() / kParts;
  std::array<double, kParts> sums{};
  for (std::size_t i = 0; i < length; ++i) {
    for (std::size_t k = 0; k < kParts; ++k) c[k * length + i] = sums[k] += c[k * length + i];
  }
  for (std::size_t i = kParts * length; i < c.size(); ++i) c[i] = sums.back() += c[i];
  double below = 0.0;
  std::array<double, kParts> offsets{};
  for (std::size_t k = 0; k < kParts; ++k) {
    offsets[k] = below;
    below += sums[k];
  }
  const double scale = 1.0 / below;
  for (std::size_t k = 0; k < kParts; ++k) {
    const std::size_t end = k + 1 < kParts ? (k + 1) * length : c.size();
    for (std::size_t i = k * length; i < end; ++i) c[i] = std::min((c[i] + offsets[k]) * scale, 1.0);
  }
  c.back() = 1.0;
}

}  // namespace

std::vector<double> cumulative_weights(std::span<const double> normalized_log_weights) {
  std::vector<double> cumulative;
  cumulative_weights(normalized_log_weights, cumulative);
  return cumulative;
}

void cumulative_weights(std::span<const double> normalized_log_weights, std::vector<double>& cumulative) {
  CAIRN_ASSERT(!normalized_log_weights.empty());
  cumulative.resize(normalized_log_weights.size());
  exp_all(normalized_log_weights, 0.0, cumulative);
  sum_up(cumulative);
}

void cumulative_sums(std::span<const double> weights, std::vector<double>& cumulative) {
  CAIRN_ASSERT(!weights.empty());
  cumulative.assign(weights.begin(), weights.end());
  sum_up(cumulative);
}

}  // namespace cairn
