#include "cairn/models/search/least_cost_windows.hpp"

#include "mini_maps.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

class LeastCostWindowsTest : public ::testing::Test {
 protected:
  OccupancyGrid map_ = test::mini_room();
  LikelihoodFieldOptions model_;
  DistanceField field_{map_, model_.max_distance_m};
  LeastCostWindows windows_{field_, model_, {0, 0, 160, 100}, 24};
};

double oracle(const DistanceField& field, const LikelihoodFieldOptions& o, int column, int row) {
  const bool inside = field.geometry().contains(column, row);
  const double d = inside ? field.distance_m(field.geometry().index(column, row)) : o.max_distance_m;
  const double hit = std::exp(-d * d / (2.0 * o.sigma_hit_m * o.sigma_hit_m));
  return -std::log((o.z_hit * hit + o.z_rand) / (o.z_hit + o.z_rand));
}

TEST_F(LeastCostWindowsTest, CostsAreThoseOfTheLikelihoodField) {
  for (const auto& [column, row] : {std::pair{0, 0}, {5, 5}, {112, 58}, {-1, 3}, {160, 3}, {3, 1000}}) {
    EXPECT_NEAR(windows_.cost(column, row), oracle(field_, model_, column, row), 1e-5)
        << column << ' ' << row;
  }
}

TEST_F(LeastCostWindowsTest, SizesGrowByAtMostHalf) {
  for (std::size_t i = 1; i < windows_.planes(); ++i) {
    EXPECT_GT(windows_.plane(i).size(), windows_.plane(i - 1).size());
    EXPECT_LE(windows_.plane(i).size(), std::max(2, windows_.plane(i - 1).size() * 3 / 2));
  }
  EXPECT_EQ(windows_.plane(windows_.plane_for(5)).size(), 6);
  EXPECT_EQ(windows_.plane_for(25), windows_.planes());
}

// Every plane against a plain search of each window, inside, across the border and outside.
TEST_F(LeastCostWindowsTest, AWindowCostsTheLeastOfItsCellsRoundedDown) {
  for (std::size_t i = 0; i < windows_.planes(); ++i) {
    const auto& plane = windows_.plane(i);
    for (int row = -30; row < 130; row += 13) {
      for (int column = -30; column < 190; column += 17) {
        double least = 1e9;
        for (int r = row; r < row + plane.size(); ++r) {
          for (int c = column; c < column + plane.size(); ++c) least = std::min(least, windows_.cost(c, r));
        }
        EXPECT_EQ(plane.at(column, row), static_cast<int>(least / windows_.cost_per_step() + 1e-9))
            << column << ' ' << row << ' ' << plane.size();
      }
    }
  }
}

TEST(LeastCostWindows, AModelThatNoDistanceChangesCostsNothing) {
  const OccupancyGrid map = test::mini_room();
  LikelihoodFieldOptions model;
  model.z_hit = 0.0;
  const LeastCostWindows windows(DistanceField(map, 1.0), model, {0, 0, 160, 100}, 4);
  EXPECT_EQ(windows.cost(50, 50), 0.0);
  EXPECT_EQ(windows.plane(0).at(50, 50), 0);
}

}  // namespace
}  // namespace cairn
