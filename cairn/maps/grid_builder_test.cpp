#include "cairn/maps/grid_builder.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace cairn {
namespace {

GridBuilderOptions options(double resolution_m = 1.0, double uncleared_m = 0.0) {
  GridBuilderOptions o;
  o.resolution_m = resolution_m;
  o.uncleared_m = uncleared_m;
  return o;
}

int cell_at(const OccupancyGrid& grid, Point2 p) {
  const Point2 c = grid.geometry().to_cells(p);
  return grid
      .cells()[grid.geometry().index(static_cast<int>(std::floor(c.x)), static_cast<int>(std::floor(c.y)))];
}

TEST(GridBuilder, OneBeamClearsItsCellsAndHitsTheLast) {
  GridBuilder builder(options());
  builder.add({0.5, 0.5, 0}, std::vector<Point2>{{3.0, 0.0}});
  const OccupancyGrid grid = builder.build();
  EXPECT_EQ(grid.geometry(), (GridGeometry{4, 1, 1.0, {0, 0, 0}}));
  EXPECT_EQ(grid.cells(), (std::vector<OccupancyGrid::Cell>{0, 0, 0, 100}));
}

TEST(GridBuilder, FollowsEveryCellThatABeamTouches) {
  GridBuilder builder(options());
  builder.add({0.5, 0.25, 0}, std::vector<Point2>{{2.0, 1.0}});  // to (2.5, 1.25): crosses y = 1 at x = 2
  const OccupancyGrid grid = builder.build();
  EXPECT_EQ(cell_at(grid, {0.5, 0.5}), 0);
  EXPECT_EQ(cell_at(grid, {1.5, 0.5}), 0);
  EXPECT_EQ(cell_at(grid, {2.5, 1.5}), 100);
  EXPECT_EQ(cell_at(grid, {0.5, 1.5}), OccupancyGrid::kUnknown);
}

TEST(GridBuilder, EveryRayEndsInItsOwnCellByConnectedSteps) {
  for (int k = 0; k < 720; ++k) {
    const double a = k * kPi / 360;
    GridBuilder builder(options());
    const Point2 end{7.3 * std::cos(a), 7.3 * std::sin(a)};
    builder.add({0.4, -0.7, 0}, std::vector<Point2>{end});
    const OccupancyGrid grid = builder.build();
    EXPECT_EQ(cell_at(grid, {0.4 + end.x, -0.7 + end.y}), 100) << k;
    // A connected path of single steps has as many cells as the two axes have steps, and one.
    const int steps =
        static_cast<int>(std::abs(std::floor(0.4 + end.x)) + std::abs(std::floor(-0.7 + end.y) + 1));
    const auto free = static_cast<int>(grid.count(CellState::kFree));
    EXPECT_NEAR(free, steps, 1) << k;  // one less where the beam leaves through a corner
  }
}

TEST(GridBuilder, CountsScansNotBeams) {
  GridBuilder builder(options());
  // Three beams end in the cell (3, 0), a fourth passes through it; a second scan passes twice.
  builder.add({0.5, 0.5, 0}, std::vector<Point2>{{3.0, 0.0}, {3.1, 0.0}, {2.9, 0.1}, {6.0, 0.0}});
  EXPECT_EQ(cell_at(builder.build(), {3.5, 0.5}), 100);
  builder.add({0.5, 0.5, 0}, std::vector<Point2>{{5.0, 0.0}, {6.0, 0.0}});
  const OccupancyGrid grid = builder.build();
  EXPECT_EQ(cell_at(grid, {3.5, 0.5}), 50);
  EXPECT_EQ(grid.state_at({3.5, 0.5}), CellState::kOccupied);
  EXPECT_EQ(grid.state_at({1.5, 0.5}), CellState::kFree);
}

TEST(GridBuilder, AWallSurvivesGrazingScans) {
  GridBuilder builder(options(0.05, 0.05));
  // Driving 4 m along the wall y = 1, a beam per degree towards it, ranges with 1 cm of ripple.
  for (int i = 0; i < 80; ++i) {
    std::vector<Point2> ends;
    for (int degree = 3; degree <= 177; ++degree) {
      const double a = degrees_to_radians(degree);
      const double range = std::min(1.0 / std::sin(a), 15.0) + 0.01 * std::sin(12.9898 * degree + 78.233 * i);
      ends.push_back({range * std::cos(a), range * std::sin(a)});
    }
    builder.add({0.05 * i, 0.0, 0.0}, ends);
  }
  const OccupancyGrid grid = builder.build();
  for (double x = 0.025; x < 4.0; x += 0.05) {
    const bool is_wall =
        grid.state_at({x, 0.99}) == CellState::kOccupied || grid.state_at({x, 1.01}) == CellState::kOccupied;
    EXPECT_TRUE(is_wall) << "hole at x = " << x;
    EXPECT_EQ(grid.state_at({x, 0.5}), CellState::kFree);
    EXPECT_NE(grid.state_at({x, 0.88}), CellState::kOccupied);
  }
}

TEST(GridBuilder, BeyondTheMaximumRangeABeamOnlyClears) {
  GridBuilderOptions o = options();
  o.max_range_m = 2.0;
  GridBuilder builder(o);
  builder.add({0.5, 0.5, 0}, std::vector<Point2>{{5.0, 0.0}});
  const OccupancyGrid grid = builder.build();
  EXPECT_EQ(grid.geometry().width, 3);
  EXPECT_EQ(grid.count(CellState::kOccupied), 0u);
}

TEST(GridBuilder, LeavesTheLastMetresUncleared) {
  GridBuilder builder(options(1.0, 1.6));
  builder.add({0.5, 0.5, 0}, std::vector<Point2>{{5.0, 0.0}});
  EXPECT_EQ(builder.build().cells(), (std::vector<OccupancyGrid::Cell>{0, 0, 0, 0, -1, 100}));
}

TEST(GridBuilder, GrowsInEveryDirectionWithoutLosingCounts) {
  GridBuilder builder(options(0.1));
  const std::vector<Point2> ahead = {{5.0, 0.0}};
  builder.add({0.05, 0.05, 0}, ahead);
  for (int i = 0; i < 8; ++i) builder.add({50.05 * std::cos(i), 50.05 * std::sin(i), double(i)}, ahead);
  builder.add({0.05, 0.05, 0}, ahead);
  const OccupancyGrid grid = builder.build();
  EXPECT_EQ(grid.count(CellState::kOccupied), 9u);
  EXPECT_EQ(cell_at(grid, {5.05, 0.05}), 100);
  EXPECT_EQ(builder.scans(), 10);
}

TEST(GridBuilder, MinimumOfObservations) {
  GridBuilderOptions o = options();
  o.min_observations = 2;
  GridBuilder builder(o);
  builder.add({0.5, 0.5, 0}, std::vector<Point2>{{3.0, 0.0}});
  builder.add({0.5, 0.5, 0}, std::vector<Point2>{{1.0, 0.0}});
  EXPECT_EQ(builder.build().cells(), (std::vector<OccupancyGrid::Cell>{0, 50, -1, -1}));
}

TEST(GridBuilder, RefusesWhatIsNotFiniteOrTooLargeAndStaysAsItWas) {
  GridBuilder builder(options(0.05));
  builder.add({0, 0, 0}, std::vector<Point2>{{3.0, 0.0}});
  const auto before = builder.build().cells();
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  for (const Point2& bad : {Point2{nan, 0}, Point2{0, inf}, Point2{1e300, 0}, Point2{1e6, 1e6}}) {
    EXPECT_THROW(builder.add({0, 0, 0}, std::vector<Point2>{{1.0, 0.0}, bad}), InputError);
  }
  EXPECT_THROW(builder.add({nan, 0, 0}, std::vector<Point2>{{1.0, 0.0}}), InputError);
  EXPECT_THROW(builder.add({1e7, 0, 0}, std::vector<Point2>{{1.0, 0.0}}), InputError);
  EXPECT_EQ(builder.build().cells(), before);
}

TEST(GridBuilder, OfNothingIsAnError) {
  GridBuilder builder;
  builder.add({0, 0, 0}, {});
  EXPECT_THROW(builder.build(), InputError);
}

TEST(GridBuilder, RefusesOptionsOutOfRange) {
  const auto refused = [](auto change) {
    GridBuilderOptions o;
    change(o);
    EXPECT_THROW(GridBuilder{o}, ConfigurationError);
  };
  refused([](auto& o) { o.resolution_m = 0.0; });
  refused([](auto& o) { o.resolution_m = std::nan(""); });
  refused([](auto& o) { o.max_range_m = -1.0; });
  refused([](auto& o) { o.uncleared_m = -0.1; });
  refused([](auto& o) { o.min_observations = 0; });
  refused([](auto& o) { o.occupied_share = 1.0; });
  refused([](auto& o) { o.free_share = 0.5; });
  refused([](auto& o) { o.max_cells = 0; });
}

}  // namespace
}  // namespace cairn
