#include "cairn/bayes/tempering.hpp"

#include "cairn/core/statistics.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// A Gaussian log-likelihood over evenly spaced particles.
std::vector<double> narrow(std::size_t n, double sharpness) {
  std::vector<double> l;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = static_cast<double>(i) / static_cast<double>(n) - 0.5;
    l.push_back(-sharpness * x * x);
  }
  return l;
}

const std::vector<double> kFlat(1000, -std::log(1000.0));

double ess_with(const std::vector<double>& priors, const std::vector<double>& likelihoods, double exponent) {
  std::vector<double> w = priors;
  for (std::size_t i = 0; i < w.size(); ++i) w[i] += exponent * likelihoods[i];
  normalize_log_weights(w);
  return effective_sample_size(w);
}

TEST(Tempering, AFlatEnoughLikelihoodEntersWhole) {
  EXPECT_EQ(tempering_exponent(kFlat, narrow(1000, 1.0), 500.0), 1.0);
  EXPECT_EQ(tempering_exponent(kFlat, narrow(1000, 1.0), 500.0, 0.3), 0.3);
  EXPECT_EQ(tempering_exponent(kFlat, std::vector<double>(1000, -7e5), 999.0), 1.0);
}

TEST(Tempering, ANarrowOneKeepsTheWantedSampleSizeAndNoMore) {
  const auto likelihoods = narrow(1000, 3e3);
  for (const double min_ess : {50.0, 100.0, 500.0}) {
    const double b = tempering_exponent(kFlat, likelihoods, min_ess);
    EXPECT_LT(b, 1.0);
    EXPECT_GE(ess_with(kFlat, likelihoods, b), min_ess);
    EXPECT_LT(ess_with(kFlat, likelihoods, b * 1.002), min_ess);  // bisection to 1e-3 in log b
  }
}

TEST(Tempering, FallsWithTheSampleSizeAskedFor) {
  const auto likelihoods = narrow(1000, 3e3);
  double last = 1.0;
  for (const double min_ess : {50.0, 100.0, 200.0, 500.0, 900.0}) {
    const double b = tempering_exponent(kFlat, likelihoods, min_ess);
    EXPECT_LT(b, last) << min_ess;
    last = b;
  }
}

TEST(Tempering, FallsWithTheSharpness) {
  const double b = tempering_exponent(kFlat, narrow(1000, 1e5), 200.0);
  EXPECT_NEAR(tempering_exponent(kFlat, narrow(1000, 2e5), 200.0), b / 2.0, 2e-3 * b);
}

TEST(Tempering, CountsThePriorsIn) {
  std::vector<double> priors = narrow(1000, 50.0);
  normalize_log_weights(priors);
  const auto likelihoods = narrow(1000, 1e4);
  const double b = tempering_exponent(priors, likelihoods, 100.0);
  EXPECT_GE(ess_with(priors, likelihoods, b), 100.0);
  EXPECT_LT(b, tempering_exponent(kFlat, likelihoods, 100.0));
}

TEST(Tempering, WhenThePriorsAloneHaveLessAlmostNothingEnters) {
  std::vector<double> priors(1000, -1e3);
  priors[0] = 0.0;
  const double b = tempering_exponent(priors, narrow(1000, 1e6), 100.0, 0.5);
  EXPECT_GT(b, 0.0);
  EXPECT_LE(b, 0.5 * 1.002e-4);
}

TEST(Tempering, NothingToKeep) {
  EXPECT_EQ(tempering_exponent(kFlat, narrow(1000, 1e9), 0.0), 1.0);
  EXPECT_EQ(tempering_exponent(kFlat, narrow(1000, 1e9), 1.0), 1.0);
  EXPECT_EQ(tempering_exponent({}, {}, 100.0, 0.25), 0.25);
  EXPECT_THROW(tempering_exponent(kFlat, {}, 100.0), std::logic_error);
}

TEST(Tempering, ExtremeLikelihoodsStayFinite) {
  std::vector<double> likelihoods(1000, -1e300);
  likelihoods[3] = 0.0;
  const double b = tempering_exponent(kFlat, likelihoods, 100.0);
  EXPECT_TRUE(b > 0.0 && b <= 1.002e-4) << b;
}

}  // namespace
}  // namespace cairn
