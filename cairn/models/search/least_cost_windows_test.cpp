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
  LeastCostWindows windows_{field_, model_, {0, 0, 160, 100}};
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

TEST_F(LeastCostWindowsTest, SizesGrowByAtMostAThird) {
  for (int tier = 1; tier < LeastCostWindows::kTiers; ++tier) {
    const auto& planes = windows_.planes(tier);
    EXPECT_EQ(planes.front().size(), LeastCostWindows::stride(tier));
    for (std::size_t i = 1; i < planes.size(); ++i) {
      EXPECT_GT(planes[i].size(), planes[i - 1].size());
      EXPECT_LE(3 * planes[i].size(), 4 * planes[i - 1].size());
    }
    EXPECT_EQ(windows_.plane_for(tier, planes[0].size() + 1), &planes[1]);
    EXPECT_EQ(windows_.plane_for(tier, planes.back().size() + 1), nullptr);
  }
}

// Every plane against a plain search of each window, inside, across the border and outside.
TEST_F(LeastCostWindowsTest, AWindowCostsTheLeastOfItsCellsRoundedDown) {
  for (int tier = 0; tier < LeastCostWindows::kTiers; ++tier) {
    for (const auto& plane : windows_.planes(tier)) {
      for (int row = -150; row < 130; row += 23) {
        for (int column = -150; column < 190; column += 37) {
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
}

TEST_F(LeastCostWindowsTest, ABlockHoldsWindowsAStrideApart) {
  for (int tier = 0; tier < LeastCostWindows::kTiers; ++tier) {
    const int step = LeastCostWindows::stride(tier);
    for (const auto& plane : windows_.planes(tier)) {
      for (const auto& [column, row] : {std::pair{3, 5}, {-70, 40}, {158, 97}, {-900, 20}, {20, 900}}) {
        const BlockPlace block = plane.block(column, row);
        for (int i = 0; i < 16; ++i) {
          EXPECT_EQ(block.at(static_cast<std::size_t>(i % 4), static_cast<std::size_t>(i / 4)),
                    plane.at(column + i % 4 * step, row + i / 4 * step))
              << column << ' ' << row << ' ' << plane.size() << ' ' << i;
        }
      }
    }
  }
}

TEST(LeastCostWindows, AModelThatNoDistanceChangesCostsNothing) {
  const OccupancyGrid map = test::mini_room();
  LikelihoodFieldOptions model;
  model.z_hit = 0.0;
  const LeastCostWindows windows(DistanceField(map, 1.0), model, {0, 0, 160, 100});
  EXPECT_EQ(windows.cost(50, 50), 0.0);
  EXPECT_EQ(windows.planes(0)[0].at(50, 50), 0);
}

}  // namespace
}  // namespace cairn
