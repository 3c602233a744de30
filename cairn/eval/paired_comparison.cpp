#include "cairn/eval/paired_comparison.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/core/rng.hpp"

#include <cmath>
#include <vector>

namespace cairn {
namespace {

constexpr std::size_t kMostExact = 14;
// Items of the bootstrap's stream begin at 0: these signs must not be drawn from the same numbers.
constexpr std::uint16_t kSignDraw = 1;
// Sums of the same numbers in another order of signs differ by rounding.
constexpr double kRounding = 1e-12;

template <typename IsFlipped>
bool as_far(const std::vector<double>& differences, double observed, IsFlipped is_flipped) {
  double sum = 0.0;
  for (std::size_t i = 0; i < differences.size(); ++i)
    sum += is_flipped(i) ? -differences[i] : differences[i];
  return std::abs(sum) >= observed * (1.0 - kRounding);
}

double exact_p(const std::vector<double>& differences, double observed) {
  const std::size_t ways = std::size_t{1} << differences.size();
  std::size_t far = 0;
  for (std::size_t way = 0; way < ways; ++way) {
    far += as_far(differences, observed, [&](std::size_t i) { return ((way >> i) & 1U) != 0; }) ? 1 : 0;
  }
  return static_cast<double>(far) / static_cast<double>(ways);
}

double sampled_p(const std::vector<double>& differences, double observed, const BootstrapOptions& options) {
  int far = 0;
  for (int draw = 0; draw < options.resamples; ++draw) {
    const RandomStream random(options.seed, RandomPurpose::kEvaluation, static_cast<std::uint64_t>(draw));
    const auto is_flipped = [&](std::size_t i) {
      return random.uniform(static_cast<std::uint32_t>(i), kSignDraw) < 0.5;
    };
    far += as_far(differences, observed, is_flipped) ? 1 : 0;
  }
  return (far + 1.0) / (options.resamples + 1.0);
}

}  // namespace

PairedComparison compare_paired(std::span<const double> a, std::span<const double> b,
                                const BootstrapOptions& options) {
  CAIRN_ASSERT(a.size() == b.size());
  std::vector<double> differences;
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    differences.push_back(b[i] - a[i]);
    sum += differences.back();
  }
  PairedComparison result{bootstrap_mean(differences, options), 1.0};
  if (differences.empty()) return result;
  const double observed = std::abs(sum);
  result.p_value = differences.size() <= kMostExact ? exact_p(differences, observed)
                                                    : sampled_p(differences, observed, options);
  return result;
}

}  // namespace cairn
