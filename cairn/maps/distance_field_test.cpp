#include "cairn/maps/distance_field.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/core/rng.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr OccupancyGrid::Cell kWall = 100;

// Every cell against every occupied cell.
std::vector<float> brute_force(const OccupancyGrid& grid, double max_distance_m) {
  const GridGeometry& g = grid.geometry();
  std::vector<float> distances;
  for (int row = 0; row < g.height; ++row) {
    for (int column = 0; column < g.width; ++column) {
      double nearest = max_distance_m;
      for (int r = 0; r < g.height; ++r) {
        for (int c = 0; c < g.width; ++c) {
          if (grid.state(g.index(c, r)) != CellState::kOccupied) continue;
          nearest = std::min(nearest, std::hypot(c - column, r - row) * g.resolution_m);
        }
      }
      distances.push_back(static_cast<float>(nearest));
    }
  }
  return distances;
}

void expect_exact(int width, int height, const std::vector<OccupancyGrid::Cell>& cells,
                  double max_distance_m = 1e3) {
  const OccupancyGrid grid({width, height, 0.1, {1, 2, 0.5}}, cells);
  const DistanceField field(grid, max_distance_m);
  EXPECT_EQ(field.geometry(), grid.geometry());
  const auto expected = brute_force(grid, max_distance_m);
  const std::vector<float> distances = field.all_distances_m();
  ASSERT_EQ(distances.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_FLOAT_EQ(distances[i], expected[i]) << width << " x " << height << ", cell " << i;
  }
}

// Random cells: a wall with the given probability, else free or unknown.
std::vector<OccupancyGrid::Cell> random_cells(int count, double walls, std::uint64_t step) {
  const RandomStream random(1, RandomPurpose::kTest, step);
  std::vector<OccupancyGrid::Cell> cells;
  for (int i = 0; i < count; ++i) {
    const auto u = random.uniform4(static_cast<std::uint32_t>(i));
    cells.push_back(u[0] < walls ? kWall : (u[1] < 0.5 ? 0 : OccupancyGrid::kUnknown));
  }
  return cells;
}

TEST(DistanceField, EqualsBruteForceOnRandomGrids) {
  std::uint64_t step = 0;
  for (const auto& [width, height] : {std::pair{13, 9}, {9, 13}, {1, 17}, {17, 1}, {20, 20}, {2, 2}}) {
    for (const double walls : {0.01, 0.05, 0.3, 0.9}) {
      for (const double max_distance_m : {1e3, 0.35}) {
        expect_exact(width, height, random_cells(width * height, walls, step++), max_distance_m);
      }
    }
  }
}

TEST(DistanceField, OneWallInEveryPlace) {
  for (std::size_t wall = 0; wall < 35; ++wall) {
    std::vector<OccupancyGrid::Cell> cells(35, 0);
    cells[wall] = kWall;
    expect_exact(7, 5, cells);
    expect_exact(35, 1, cells);
    expect_exact(1, 35, cells);
  }
}

TEST(DistanceField, FullAndSingleCells) {
  expect_exact(6, 4, std::vector<OccupancyGrid::Cell>(24, kWall));
  expect_exact(1, 1, {kWall});
  EXPECT_EQ(DistanceField(OccupancyGrid({1, 1, 0.1, {}}, {kWall}), 2.0).distance_m(0), 0.0f);
}

TEST(DistanceField, WithoutAWallEverythingIsFar) {
  for (const auto& [width, height] : {std::pair{1, 1}, {6, 4}, {1, 9}, {9, 1}}) {
    const std::vector<OccupancyGrid::Cell> cells(static_cast<std::size_t>(width * height), 0);
    const DistanceField field(OccupancyGrid({width, height, 0.1, {}}, cells), 2.5);
    for (const float d : field.all_distances_m()) EXPECT_EQ(d, 2.5f);
  }
}

TEST(DistanceField, UnknownCellsAreNoWalls) {
  const DistanceField field(OccupancyGrid({3, 1, 1.0, {}}, {-1, 50, kWall}), 9.0);
  EXPECT_EQ(field.all_distances_m(), (std::vector<float>{2.0f, 1.0f, 0.0f}));
}

TEST(DistanceField, IsCutAtTheLargestDistance) {
  std::vector<OccupancyGrid::Cell> cells(100, 0);
  cells[0] = kWall;
  const DistanceField field(OccupancyGrid({100, 1, 0.1, {}}, cells), 2.0);
  EXPECT_EQ(field.max_distance_m(), 2.0);
  EXPECT_FLOAT_EQ(field.distance_m(19), 1.9f);
  EXPECT_EQ(field.distance_m(20), 2.0f);
  EXPECT_EQ(field.distance_m(99), 2.0f);
}

TEST(DistanceField, AWallAtTheFarEndOfALongRow) {
  std::vector<OccupancyGrid::Cell> cells(20'000, 0);
  cells.back() = kWall;
  const DistanceField field(OccupancyGrid({20'000, 1, 0.05, {}}, cells), 1e4);
  EXPECT_FLOAT_EQ(field.distance_m(0), static_cast<float>(19'999 * 0.05));
}

TEST(DistanceField, RefusesALargestDistanceThatIsNotPositive) {
  const OccupancyGrid grid({1, 1, 1.0, {}}, {0});
  for (const double d : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(DistanceField(grid, d), ConfigurationError) << d;
  }
}

}  // namespace
}  // namespace cairn
