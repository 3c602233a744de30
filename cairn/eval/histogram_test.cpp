#include "cairn/eval/histogram.hpp"

#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(Histogram, CountsEveryValueOnce) {
  std::vector<double> values;
  for (int i = 0; i <= 100; ++i) values.push_back(0.001 * i);
  const Histogram histogram = make_histogram(values);
  EXPECT_DOUBLE_EQ(histogram.width, 0.005);
  EXPECT_EQ(std::accumulate(histogram.counts.begin(), histogram.counts.end(), histogram.beyond), 101);
  EXPECT_EQ(histogram.counts[0], 5);
}

TEST(Histogram, HasAReadableNumberOfBinsForAnySize) {
  for (double max = 1e-6; max < 1e6; max *= 1.37) {
    const Histogram histogram = make_histogram(std::vector<double>{0.0, max / 3, max});
    EXPECT_GE(histogram.counts.size(), 15u) << max;
    EXPECT_LE(histogram.counts.size(), 40u) << max;
  }
}

TEST(Histogram, AFewFarValuesDoNotHideTheRest) {
  std::vector<double> values(1000, 0.03);
  for (std::size_t i = 0; i < 500; ++i) values[i] = 0.01;
  values[7] = 50.0;
  values[8] = 1e300;
  const Histogram histogram = make_histogram(values);
  EXPECT_DOUBLE_EQ(histogram.width, 0.001);
  EXPECT_EQ(histogram.beyond, 2);
  EXPECT_EQ(std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::int64_t{0}), 998);
}

TEST(Histogram, CopesWithNothingAndWithZeros) {
  EXPECT_THAT(make_histogram({}).counts, testing::ElementsAre(0));
  EXPECT_THAT(make_histogram(std::vector<double>{0.0, 0.0}).counts, testing::ElementsAre(2));
}

}  // namespace
}  // namespace cairn
