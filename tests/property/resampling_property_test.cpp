#include "cairn/bayes/resampling/resampling_schemes.hpp"
#include "drawn_counts.hpp"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

namespace cairn::test {
namespace {

// Weights from nothing to much, at least one of which counts.
rc::Gen<std::vector<double>> arbitrary_weights() {
  const auto weight = rc::gen::weightedOneOf<double>(
      {{1, rc::gen::just(0.0)},
       {3, rc::gen::map(rc::gen::inRange(-700, 700), [](int e) { return std::exp(e / 50.0); })},
       {1, rc::gen::map(rc::gen::inRange(-700, 0), [](int e) { return std::exp(double(e)); })}});
  return rc::gen::suchThat(rc::gen::container<std::vector<double>>(weight), [](const auto& weights) {
    return std::any_of(weights.begin(), weights.end(), [](double w) { return w > 0.0; });
  });
}

RC_GTEST_PROP(Resampling, DrawsTheRightNumberAndOnlyWhatHasWeight, ()) {
  const auto weights = *arbitrary_weights();
  const auto count = *rc::gen::inRange<std::size_t>(0, 500);
  const auto scheme = make_resampling(*rc::gen::elementOf(resampling_schemes()));
  const auto ancestors = drawn(*scheme, cumulative_of(weights), count, *rc::gen::arbitrary<std::uint64_t>());
  RC_ASSERT(ancestors.size() == count);
  for (const std::uint32_t a : ancestors) {
    RC_ASSERT(a < weights.size());
    RC_ASSERT(weights[a] > 0.0);
  }
}

RC_GTEST_PROP(Resampling, SystematicCountsLieWithinOneOfTheirExpectation, ()) {
  const auto weights = *arbitrary_weights();
  const auto count = *rc::gen::inRange<std::size_t>(1, 500);
  const auto scheme = make_resampling("systematic");
  const auto counts = counts_of(
      drawn(*scheme, cumulative_of(weights), count, *rc::gen::arbitrary<std::uint64_t>()), weights.size());
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double expected = static_cast<double>(count) * weights[i] / total;
    RC_ASSERT(std::abs(static_cast<double>(counts[i]) - expected) < 1.0 + 1e-9);
  }
}

// Which indices there are is all that matters, not where: weightless ones in between change no draw.
RC_GTEST_PROP(Resampling, WhatHasNoWeightChangesNothing, ()) {
  const auto weights = *arbitrary_weights();
  std::vector<double> without;
  std::vector<std::uint32_t> original;
  for (std::uint32_t i = 0; i < weights.size(); ++i) {
    if (weights[i] == 0.0) continue;
    without.push_back(weights[i]);
    original.push_back(i);
  }
  const auto name = *rc::gen::elementOf(resampling_schemes());
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  const auto all = drawn(*make_resampling(name), cumulative_of(weights), 100, seed);
  auto some = drawn(*make_resampling(name), cumulative_of(without), 100, seed);
  for (std::uint32_t& a : some) a = original[a];
  RC_ASSERT(all == some);
}

}  // namespace
}  // namespace cairn::test
