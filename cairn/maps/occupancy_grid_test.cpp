#include "cairn/maps/occupancy_grid.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

void expect_near(const Point2& a, const Point2& b) {
  EXPECT_NEAR(a.x, b.x, 1e-12);
  EXPECT_NEAR(a.y, b.y, 1e-12);
}

TEST(GridGeometry, RowsGoUpFromTheOrigin) {
  const GridGeometry grid{4, 3, 0.5, {10.0, 20.0, 0.0}};
  EXPECT_EQ(grid.size(), 12u);
  EXPECT_EQ(grid.index(0, 0), 0u);
  EXPECT_EQ(grid.index(3, 2), 11u);
  expect_near(grid.center(0, 0), {10.25, 20.25});
  expect_near(grid.center(3, 2), {11.75, 21.25});
  expect_near(grid.to_cells({10.0, 20.0}), {0.0, 0.0});
}

TEST(GridGeometry, AQuarterTurnByHand) {
  const GridGeometry grid{4, 3, 1.0, {10.0, 20.0, kPi / 2.0}};  // columns run along +y, rows along -x
  expect_near(grid.center(2, 1), {10.0 - 1.5, 20.0 + 2.5});
  expect_near(grid.to_cells({8.5, 22.5}), {2.5, 1.5});
}

TEST(GridGeometry, CellsAndPointsAreInverse) {
  const GridGeometry grid{5, 7, 0.05, {-3.0, 2.0, -2.5}};
  for (int row = 0; row < 7; ++row) {
    for (int column = 0; column < 5; ++column) {
      expect_near(grid.to_cells(grid.center(column, row)), {column + 0.5, row + 0.5});
    }
  }
}

TEST(GridGeometry, Contains) {
  const GridGeometry grid{4, 3, 1.0, {}};
  EXPECT_TRUE(grid.contains(0, 0) && grid.contains(3, 2));
  EXPECT_FALSE(grid.contains(-1, 0) || grid.contains(0, -1) || grid.contains(4, 0) || grid.contains(0, 3));
}

TEST(OccupancyGrid, StatesByTheThresholds) {
  const OccupancyGrid grid({6, 1, 1.0, {}}, {-1, 0, 24, 25, 65, 66});
  const std::vector<CellState> expected = {CellState::kUnknown, CellState::kFree,    CellState::kFree,
                                           CellState::kUnknown, CellState::kUnknown, CellState::kOccupied};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(grid.state(i), expected[i]) << i;
  EXPECT_EQ(grid.count(CellState::kFree), 2u);
  EXPECT_EQ(grid.count(CellState::kOccupied), 1u);
  EXPECT_EQ(grid.count(CellState::kUnknown), 3u);
}

TEST(OccupancyGrid, OtherThresholds) {
  const OccupancyGrid grid({3, 1, 1.0, {}}, {10, 45, 60}, {.occupied = 0.5, .free = 0.4});
  EXPECT_EQ(grid.state(0), CellState::kFree);
  EXPECT_EQ(grid.state(1), CellState::kUnknown);
  EXPECT_EQ(grid.state(2), CellState::kOccupied);
}

TEST(OccupancyGrid, StateAtAPointOfATurnedGrid) {
  const OccupancyGrid grid({2, 1, 1.0, {10.0, 20.0, kPi / 2.0}}, {0, 100});
  EXPECT_EQ(grid.state_at({9.5, 20.5}), CellState::kFree);
  EXPECT_EQ(grid.state_at({9.5, 21.5}), CellState::kOccupied);
}

TEST(OccupancyGrid, UnknownOffTheGrid) {
  const OccupancyGrid grid({2, 2, 1.0, {}}, {100, 100, 100, 100});
  EXPECT_EQ(grid.state_at({0.0, 0.0}), CellState::kOccupied);  // the lower border belongs to the cell
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Point2& p : {Point2{-1e-9, 1.0}, Point2{1.0, -1e-9}, Point2{2.0, 1.0}, Point2{1.0, 2.0},
                          Point2{1e300, 1e300}, Point2{infinity, 1.0}, Point2{kNan, kNan}}) {
    EXPECT_EQ(grid.state_at(p), CellState::kUnknown) << p.x << ' ' << p.y;
  }
}

TEST(OccupancyGrid, RefusesWhatIsNoGrid) {
  const auto make = [](const GridGeometry& geometry, std::vector<OccupancyGrid::Cell> cells) {
    OccupancyGrid(geometry, std::move(cells));
  };
  EXPECT_NO_THROW(make({1, 1, 1.0, {}}, {0}));
  EXPECT_THROW(make({0, 0, 1.0, {}}, {}), InputError);
  EXPECT_THROW(make({-1, -1, 1.0, {}}, {0}), InputError);  // -1 x -1 is one cell
  EXPECT_THROW(make({1, 1, 0.0, {}}, {0}), InputError);
  EXPECT_THROW(make({1, 1, -0.05, {}}, {0}), InputError);
  EXPECT_THROW(make({1, 1, kNan, {}}, {0}), InputError);
  EXPECT_THROW(make({1, 1, 1.0 / 0.0, {}}, {0}), InputError);
  EXPECT_THROW(make({1, 1, 1.0, {kNan, 0, 0}}, {0}), InputError);
  EXPECT_THROW(make({2, 1, 1.0, {}}, {0}), InputError);
  EXPECT_THROW(make({1, 1, 1.0, {}}, {0, 0}), InputError);
  EXPECT_THROW(make({1, 1, 1.0, {}}, {101}), InputError);
  EXPECT_THROW(make({1, 1, 1.0, {}}, {-2}), InputError);
}

}  // namespace
}  // namespace cairn
