#include "cairn/bayes/resampling/resampling_schemes.hpp"
#include "cairn/core/errors.hpp"
#include "drawn_counts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace cairn::test {
namespace {

using Counts = std::vector<std::size_t>;

class ResamplingLaws : public ::testing::TestWithParam<std::string> {
 protected:
  const std::unique_ptr<Resampling> scheme_ = make_resampling(GetParam());

  Counts counts(const std::vector<double>& weights, std::size_t count, std::uint64_t seed) const {
    return counts_of(drawn(*scheme_, cumulative_of(weights), count, seed), weights.size());
  }
};

TEST_P(ResamplingLaws, DrawsExactlyAsManyAsAsked) {
  for (const std::size_t n : {1u, 2u, 17u, 1000u}) {
    for (const std::size_t count : {0u, 1u, 2u, 64u, 999u, 5000u}) {
      const Counts c = counts(uneven_weights(n, n), count, 7);
      EXPECT_EQ(std::accumulate(c.begin(), c.end(), std::size_t{0}), count) << n;
    }
  }
}

TEST_P(ResamplingLaws, AppendsToWhatIsThere) {
  const RandomStream random(1, RandomPurpose::kResample, 0);
  std::vector<std::uint32_t> ancestors = {42};
  scheme_->draw(cumulative_of({1.0, 1.0}), 3, DrawingNumbers(random, 0), ancestors);
  EXPECT_EQ(ancestors.size(), 4u);
  EXPECT_EQ(ancestors[0], 42u);
}

TEST_P(ResamplingLaws, TheSeedDecides) {
  const auto cumulative = cumulative_of(uneven_weights(200, 1));
  const auto first = drawn(*scheme_, cumulative, 200, 1);
  drawn(*scheme_, cumulative_of(uneven_weights(50, 2)), 70, 2);  // leaves nothing behind
  EXPECT_EQ(drawn(*scheme_, cumulative, 200, 1), first);
  EXPECT_EQ(drawn(*make_resampling(GetParam()), cumulative, 200, 1), first);
  EXPECT_NE(drawn(*scheme_, cumulative, 200, 2), first);
  EXPECT_NE(drawn(*scheme_, cumulative, 200, 1, 1), first);
}

TEST_P(ResamplingLaws, OneThatWeighsAllIsAllThatIsDrawn) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    EXPECT_EQ(counts({1.0}, 100, seed), (Counts{100}));
    EXPECT_EQ(counts({0.0, 1.0, 0.0}, 100, seed), (Counts{0, 100, 0}));
    EXPECT_EQ(counts({0.0, 0.0, 1.0}, 100, seed), (Counts{0, 0, 100}));
    EXPECT_EQ(counts({1.0, 0.0, 0.0}, 100, seed), (Counts{100, 0, 0}));
  }
}

TEST_P(ResamplingLaws, WhatWeighsNothingIsNeverDrawn) {
  std::vector<double> weights = uneven_weights(500, 3);
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = i % 3 == 1 ? weights[i] : 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Counts c = counts(weights, 2000, seed);
    for (std::size_t i = 0; i < c.size(); ++i) EXPECT_TRUE(weights[i] > 0.0 || c[i] == 0) << i;
  }
}

// A weight of 1e-12 comes up in 20 * 1000 draws with probability 2e-8.
TEST_P(ResamplingLaws, TinyWeightsAreNoTrouble) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    EXPECT_EQ(counts({1e-12, 1.0, 1e-300, 1e-13}, 1000, seed), (Counts{0, 1000, 0, 0}));
  }
}

// The edges that an unlucky random number would hit: the ends of each interval of the cumulative weights.
TEST_P(ResamplingLaws, ManyParticlesStayWithinTheIndices) {
  const std::size_t n = 100'000;
  const Counts c = counts(std::vector<double>(n, 1.0), 3 * n, 5);
  EXPECT_EQ(std::accumulate(c.begin(), c.end(), std::size_t{0}), 3 * n);
}

std::string name_of(const ::testing::TestParamInfo<std::string>& info) { return info.param; }

INSTANTIATE_TEST_SUITE_P(Conformance, ResamplingLaws, ::testing::ValuesIn(resampling_schemes()), name_of);

// --- Laws of some of the schemes.

class CertainShareLaws : public ::testing::TestWithParam<std::string> {};

TEST_P(CertainShareLaws, EqualWeightsKeepEveryone) {
  const auto scheme = make_resampling(GetParam());
  for (const std::size_t n : {1u, 3u, 100u, 1000u}) {
    const auto cumulative = cumulative_of(std::vector<double>(n, 0.1));
    EXPECT_EQ(counts_of(drawn(*scheme, cumulative, n, n), n), Counts(n, 1)) << n;
    EXPECT_EQ(counts_of(drawn(*scheme, cumulative, 3 * n, n), n), Counts(n, 3)) << n;
  }
}

INSTANTIATE_TEST_SUITE_P(Conformance, CertainShareLaws,
                         ::testing::Values("systematic", "stratified", "residual"), name_of);

// How far a count may be from its expectation: systematic less than 1, stratified less than 2 (a stratum cut
// at either end), residual never a whole copy below.
TEST(Resampling, CountsStayNearTheirExpectation) {
  constexpr double kRounding = 1e-9;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto weights = uneven_weights(50, seed);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    const auto cumulative = cumulative_of(weights);
    for (const std::size_t count : {1u, 7u, 50u, 1000u}) {
      const auto count_with = [&](const char* scheme) {
        return counts_of(drawn(*make_resampling(scheme), cumulative, count, seed), 50);
      };
      const Counts systematic = count_with("systematic"), stratified = count_with("stratified"),
                   residual = count_with("residual");
      for (std::size_t i = 0; i < 50; ++i) {
        const double expected = static_cast<double>(count) * weights[i] / total;
        EXPECT_LT(std::abs(static_cast<double>(systematic[i]) - expected), 1.0 + kRounding);
        EXPECT_LT(std::abs(static_cast<double>(stratified[i]) - expected), 2.0 + kRounding);
        EXPECT_GT(static_cast<double>(residual[i]), expected - 1.0 - kRounding);
      }
    }
  }
}

TEST(Resampling, AnUnknownSchemeIsAConfigurationErrorThatNamesTheOthers) {
  try {
    make_resampling("lottery");
    FAIL();
  } catch (const ConfigurationError& error) {
    for (const std::string& name : resampling_schemes())
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace cairn::test
