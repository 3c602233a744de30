#include "cairn/bayes/weights.hpp"

#include "cairn/core/rng.hpp"
#include "cairn/core/statistics.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(NormalizeWeights, AgreesWithTheLogs) {
  for (const double offset : {0.0, -1e4, 1e5}) {
    std::vector<double> logs, weights;
    for (std::uint32_t i = 0; i < 777; ++i)
      logs.push_back(offset + 5.0 * RandomStream(1, RandomPurpose::kTest, 0).normal4(i)[0]);
    std::vector<double> expected = logs;
    normalize_log_weights(expected);
    const double ess = normalize_weights(logs, weights);
    EXPECT_NEAR(ess, effective_sample_size(expected), 1e-9 * ess);
    double sum = 0.0;
    for (std::size_t i = 0; i < logs.size(); ++i) {
      EXPECT_NEAR(logs[i], expected[i], 1e-10);
      EXPECT_NEAR(weights[i], std::exp(logs[i]), 1e-10 * weights[i]);
      sum += weights[i];
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
  }
}

TEST(NormalizeWeights, TheWorstDoNotUnderflowTheLogs) {
  std::vector<double> logs = {0.0, -5000.0}, weights;
  EXPECT_EQ(normalize_weights(logs, weights), 1.0);
  EXPECT_EQ(weights, (std::vector<double>{1.0, 0.0}));
  EXPECT_EQ(logs[1], -5000.0);
}

}  // namespace
}  // namespace cairn
