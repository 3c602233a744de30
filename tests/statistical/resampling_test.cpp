// Expectation and variance of the counts that the resampling schemes draw, against their exact values.
#include "cairn/bayes/resampling/resampling_schemes.hpp"
#include "drawn_counts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace cairn::test {
namespace {

constexpr std::size_t kIndices = 12, kCount = 20;

std::vector<double> normalized(std::vector<double> weights) {
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& w : weights) w /= total;
  return weights;
}

const std::vector<double>& test_weights() {
  static const std::vector<double> kWeights = normalized(uneven_weights(kIndices, 11));
  return kWeights;
}

class ResamplingStatistics : public ::testing::TestWithParam<std::string> {};

// One ancestor of each drawing, at a place chosen by another random number, is an independent sample of the
// weights, whatever the scheme: P = E(count_i) / count = w_i. Chi-square with 11 degrees of freedom: 52.75 is
// exceeded with probability 1e-6 / 5 (five schemes).
TEST_P(ResamplingStatistics, EveryIndexIsExpectedAsOftenAsItWeighs) {
  constexpr std::uint64_t kDrawings = 40'000;
  const auto scheme = make_resampling(GetParam());
  const auto cumulative = cumulative_of(test_weights());
  const RandomStream chooser(99, RandomPurpose::kTest, 0);
  std::vector<double> observed(kIndices);
  for (std::uint64_t k = 0; k < kDrawings; ++k) {
    const auto place = static_cast<std::size_t>(chooser.uniform(static_cast<std::uint32_t>(k)) * kCount);
    observed[drawn(*scheme, cumulative, kCount, 2, k)[place]] += 1.0;
  }
  double chi_square = 0.0;
  for (std::size_t i = 0; i < kIndices; ++i) {
    const double expected = kDrawings * test_weights()[i];
    ASSERT_GE(expected, 20.0);  // so that the statistic is chi-square distributed
    chi_square += (observed[i] - expected) * (observed[i] - expected) / expected;
  }
  EXPECT_LT(chi_square, 52.75);
  EXPECT_GT(chi_square, 0.1);  // it is a random number: the other tail, probability 1e-10
}

INSTANTIATE_TEST_SUITE_P(Schemes, ResamplingStatistics, ::testing::ValuesIn(resampling_schemes()),
                         [](const auto& chosen) { return chosen.param; });

// --- Variances.

double of_a_chance(double p) { return p * (1.0 - p); }

double fraction(double value) { return value - std::floor(value); }

using Variances = std::vector<double>;

Variances multinomial_variances() {
  Variances v;
  for (const double w : test_weights()) v.push_back(kCount * of_a_chance(w));
  return v;
}

// A count is the sum of one chance per stratum that the index overlaps.
Variances stratified_variances() {
  Variances v(kIndices);
  double begin = 0.0;
  for (std::size_t i = 0; i < kIndices; ++i) {
    const double end = begin + kCount * test_weights()[i];
    for (std::size_t k = 0; k < kCount; ++k) {
      const auto stratum = static_cast<double>(k);
      v[i] += of_a_chance(std::max(0.0, std::min(end, stratum + 1.0) - std::max(begin, stratum)));
    }
    begin = end;
  }
  return v;
}

// A count is one of the two whole numbers next to its expectation.
Variances systematic_variances() {
  Variances v;
  for (const double w : test_weights()) v.push_back(of_a_chance(fraction(kCount * w)));
  return v;
}

Variances residual_variances() {
  double to_chance = 0.0;
  for (const double w : test_weights()) to_chance += fraction(kCount * w);
  Variances v;
  for (const double w : test_weights())
    v.push_back(to_chance * of_a_chance(fraction(kCount * w) / to_chance));
  return v;
}

struct VarianceCase {
  const char* scheme;
  Variances (*exact)();
};

class ResamplingVariance : public ::testing::TestWithParam<VarianceCase> {};

// 5.6 standard errors of the sample variance: probability 2e-8 per index, 1e-6 over the 48 of all schemes.
TEST_P(ResamplingVariance, IsTheExactOne) {
  constexpr std::uint64_t kDrawings = 20'000;
  const auto scheme = make_resampling(GetParam().scheme);
  const auto cumulative = cumulative_of(test_weights());
  const Variances exact = GetParam().exact();
  std::vector<double> second(kIndices), fourth(kIndices);
  for (std::uint64_t k = 0; k < kDrawings; ++k) {
    const auto counts = counts_of(drawn(*scheme, cumulative, kCount, 3, k), kIndices);
    for (std::size_t i = 0; i < kIndices; ++i) {
      const double deviation = static_cast<double>(counts[i]) - kCount * test_weights()[i];
      second[i] += deviation * deviation / kDrawings;
      fourth[i] += std::pow(deviation, 4) / kDrawings;
    }
  }
  for (std::size_t i = 0; i < kIndices; ++i) {
    const double standard_error = std::sqrt((fourth[i] - second[i] * second[i]) / kDrawings);
    EXPECT_LT(standard_error, 0.05);
    EXPECT_NEAR(second[i], exact[i], 5.6 * standard_error + 1e-9) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Schemes, ResamplingVariance,
                         ::testing::Values(VarianceCase{"multinomial", multinomial_variances},
                                           VarianceCase{"stratified", stratified_variances},
                                           VarianceCase{"systematic", systematic_variances},
                                           VarianceCase{"residual", residual_variances}),
                         [](const auto& chosen) { return std::string(chosen.param.scheme); });

TEST(ResamplingVariance, SystematicIsAtMostStratifiedIsAtMostMultinomial) {
  const Variances systematic = systematic_variances(), stratified = stratified_variances(),
                  residual = residual_variances(), multinomial = multinomial_variances();
  for (std::size_t i = 0; i < kIndices; ++i) {
    EXPECT_LE(systematic[i], stratified[i] + 1e-12) << i;
    EXPECT_LE(stratified[i], multinomial[i] + 1e-12) << i;
    EXPECT_LE(residual[i], multinomial[i] + 1e-12) << i;
  }
}

}  // namespace
}  // namespace cairn::test
