#include "cairn/models/search/rotated_points.hpp"

#include "cairn/core/angle.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

const std::vector<Point2> kPoints{{10.2, 0.0}, {-3.0, 40.7}, {0.3, -0.4}};

TEST(RotatedPoints, TurnsToWholeCells) {
  const RotatedPoints turned(kPoints, 64, 4);
  ASSERT_EQ(turned.at(0, 16).size(), kPoints.size());  // a quarter turn
  EXPECT_EQ(turned.at(0, 16)[0].column, 0);
  EXPECT_EQ(turned.at(0, 16)[0].row, 10);
  EXPECT_EQ(turned.at(0, 16)[1].column, -41);
  EXPECT_EQ(turned.at(0, 16)[1].row, -3);
  EXPECT_EQ(turned.at(0, 16)[2].side, 1);
  EXPECT_DOUBLE_EQ(turned.heading_step_rad(), kTwoPi / 64);
}

// What makes the bounds of the search hold.
TEST(RotatedPoints, AGroupReachesEveryCellOfItsHeadings) {
  const RotatedPoints turned(kPoints, 64, 4);
  for (int level = 1; level < 4; ++level) {
    for (int heading = 0; heading < 64; ++heading) {
      const auto group = turned.at(level, heading >> level);
      const auto single = turned.at(0, heading);
      for (std::size_t k = 0; k < kPoints.size(); ++k) {
        EXPECT_GE(single[k].column, group[k].column);
        EXPECT_GE(single[k].row, group[k].row);
        EXPECT_LT(single[k].column, group[k].column + group[k].side);
        EXPECT_LT(single[k].row, group[k].row + group[k].side);
      }
    }
  }
  EXPECT_EQ(turned.headings(3), 8);
}

}  // namespace
}  // namespace cairn
