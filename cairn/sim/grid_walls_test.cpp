#include "cairn/sim/grid_walls.hpp"

#include "cairn/maps/ray_casting.hpp"

#include <memory>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// Two occupied cells side by side in a grid of 4 x 3 cells of half a metre, whose corner lies at (10, 0).
TEST(GridWalls, OutlineOfOccupiedCells) {
  std::vector<OccupancyGrid::Cell> cells(12, 0);
  cells[5] = cells[6] = 100;
  const std::vector<Wall> walls = walls_of_grid({{4, 3, 0.5, {10.0, 0.0, 0.0}}, cells});
  EXPECT_EQ(walls.size(), 4U) << "neighbouring edges are one wall";
  const auto map = std::make_shared<const VectorMap>(walls);
  const WallGrid grid(map, kAllMaterials);
  EXPECT_DOUBLE_EQ(cast_ray(grid, {10.0, 0.75}, {1.0, 0.0}).range_m, 0.5);
  EXPECT_DOUBLE_EQ(cast_ray(grid, {11.0, 0.0}, {0.0, 1.0}).range_m, 0.5);
  EXPECT_DOUBLE_EQ(cast_ray(grid, {11.0, 1.5}, {0.0, -1.0}).range_m, 0.5);
  EXPECT_FALSE(cast_ray(grid, {10.0, 0.25}, {1.0, 0.0}));
}

TEST(GridWalls, CellsAtTheEdgeOfTheGridHaveWallsToo) {
  EXPECT_EQ(walls_of_grid({{1, 1, 1.0, {}}, {100}}).size(), 4U);
  EXPECT_TRUE(walls_of_grid({{2, 2, 1.0, {}}, {0, 0, -1, 0}}).empty());
}

TEST(GridWalls, WhereARobotWasIsFree) {
  std::vector<OccupancyGrid::Cell> cells(100, 100);
  const OccupancyGrid full({10, 10, 0.1, {}}, cells);
  const OccupancyGrid cleared =
      cleared_along(full, {{Time{}, {0.55, 0.55, 0.0}}, {time_from_seconds(1), {0.05, 0.95, 0.0}}}, 0.15);
  EXPECT_EQ(cleared.count(CellState::kFree), 9U + 4U)
      << "a block of nine; at the corner what lies on the grid";
  EXPECT_EQ(cleared.state_at({0.65, 0.65}), CellState::kFree);
  EXPECT_EQ(cleared.state_at({0.75, 0.55}), CellState::kOccupied);
  EXPECT_EQ(cleared_along(full, {{Time{}, {0.55, 0.55, 0.0}}}, 0.0).count(CellState::kFree), 0U);
}

}  // namespace
}  // namespace cairn
