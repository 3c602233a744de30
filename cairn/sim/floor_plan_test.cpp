#include "cairn/sim/floor_plan.hpp"

#include "cairn/core/errors.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

FloorPlan room_with_table() {
  FloorPlan plan;
  add_outline({{0.0, 0.0}, {2.0, 1.0}}, plan.walls);
  add_outline({{0.5, 0.4}, {0.8, 0.6}}, plan.walls);
  return plan;
}

TEST(FloorPlan, OutlineHasFourSides) {
  std::vector<Segment> walls;
  add_outline({{0.0, 0.0}, {3.0, 1.0}}, walls);
  ASSERT_EQ(walls.size(), 4U);
  double length = 0.0;
  for (const Segment& w : walls) length += std::abs(w.b.x - w.a.x) + std::abs(w.b.y - w.a.y);
  EXPECT_DOUBLE_EQ(length, 8.0);
}

TEST(FloorPlan, DistanceToSegment) {
  const Segment segment{{0.0, 0.0}, {2.0, 0.0}};
  EXPECT_DOUBLE_EQ(distance(Point2{1.0, -3.0}, segment), 3.0);
  EXPECT_DOUBLE_EQ(distance(Point2{5.0, 4.0}, segment), 5.0);
  EXPECT_DOUBLE_EQ(distance(Point2{-3.0, 4.0}, segment), 5.0);
  EXPECT_DOUBLE_EQ(distance(Point2{3.0, 4.0}, Segment{{0.0, 0.0}, {0.0, 0.0}}), 5.0);
}

TEST(Rasterize, CountsCellsOfARoomWithATable) {
  const OccupancyGrid grid = rasterize(room_with_table(), {0.2, 0.2}, 0.05, 0.5);
  // Outline: 41 x 21 cells less 39 x 19 inside; table: 7 x 5 less 5 x 3.
  const std::size_t outline = 41 * 21 - 39 * 19;
  const std::size_t table = 7 * 5 - 5 * 3;
  EXPECT_EQ(grid.count(CellState::kOccupied), outline + table);
  EXPECT_EQ(grid.count(CellState::kFree), 39U * 19U - 7U * 5U);
}

TEST(Rasterize, TellsInsideWallAndBeyond) {
  const OccupancyGrid grid = rasterize(room_with_table(), {0.2, 0.2}, 0.05);
  EXPECT_EQ(grid.state_at({1.5, 0.5}), CellState::kFree);
  EXPECT_EQ(grid.state_at({2.0, 0.5}), CellState::kOccupied);
  EXPECT_EQ(grid.state_at({0.65, 0.5}), CellState::kUnknown);  // within the table
  EXPECT_EQ(grid.state_at({2.2, 0.5}), CellState::kUnknown);
}

TEST(Rasterize, WallsOnMultiplesOfTheResolutionLieAtCellCentres) {
  const OccupancyGrid grid = rasterize(room_with_table(), {0.2, 0.2}, 0.05);
  const Point2 cell = grid.geometry().to_cells({2.0, 0.5});
  EXPECT_NEAR(cell.x - std::floor(cell.x), 0.5, 1e-6);
  EXPECT_NEAR(cell.y - std::floor(cell.y), 0.5, 1e-6);
}

TEST(Rasterize, RefusesWhatItCannotDraw) {
  EXPECT_THROW(rasterize({}, {0.0, 0.0}, 0.05), ConfigurationError);
  EXPECT_THROW(rasterize(room_with_table(), {2.0, 0.5}, 0.05), ConfigurationError);
  EXPECT_THROW(rasterize(room_with_table(), {2.3, 0.5}, 0.05), ConfigurationError);
  EXPECT_THROW(rasterize(room_with_table(), {50.0, 0.5}, 0.05), ConfigurationError);
  FloorPlan open = room_with_table();
  open.walls.erase(open.walls.begin());
  EXPECT_THROW(rasterize(open, {0.2, 0.2}, 0.05), ConfigurationError);
}

}  // namespace
}  // namespace cairn
