#include "cairn/eval/downsample.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using testing::ElementsAre;

TEST(SelectExtremes, KeepsAllOfAShortCurve) {
  EXPECT_THAT(select_extremes(std::vector<double>{3, 1, 2, 5}, 4), ElementsAre(0, 1, 2, 3));
  EXPECT_TRUE(select_extremes({}, 4).empty());
}

TEST(SelectExtremes, KeepsEveryPeakOfALongCurve) {
  std::vector<double> values(100'000, 1.0);
  values[12'345] = 9.0;
  values[12'346] = -9.0;
  values[77'777] = 5.0;
  const auto indices = select_extremes(values, 400);
  EXPECT_LE(indices.size(), 400u);
  EXPECT_EQ(indices.front(), 0u);
  EXPECT_EQ(indices.back(), values.size() - 1);
  EXPECT_TRUE(std::is_sorted(indices.begin(), indices.end()));
  EXPECT_EQ(std::adjacent_find(indices.begin(), indices.end()), indices.end());
  for (const std::size_t peak : {12'345u, 12'346u, 77'777u}) {
    EXPECT_TRUE(std::binary_search(indices.begin(), indices.end(), peak)) << peak;
  }
}

TEST(SelectExtremes, UsesTheRoomItHas) {
  std::vector<double> ramp(5000);
  for (std::size_t i = 0; i < ramp.size(); ++i) ramp[i] = static_cast<double>(i);
  EXPECT_EQ(select_extremes(ramp, 4000).size(), 4000u);
  EXPECT_EQ(select_extremes(std::span(ramp).first(5), 4).size(), 4u);
  EXPECT_THROW(select_extremes(ramp, 3), std::logic_error);
}

TEST(SelectEvenly, SpreadsFromTheFirstToTheLast) {
  EXPECT_THAT(select_evenly(3, 5), ElementsAre(0, 1, 2));
  EXPECT_THAT(select_evenly(101, 5), ElementsAre(0, 25, 50, 75, 100));
  EXPECT_TRUE(select_evenly(0, 5).empty());
}

}  // namespace
}  // namespace cairn
