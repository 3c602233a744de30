#include "cairn/maps/distance_transform.hpp"

#include "cairn/core/rng.hpp"
#include "simd_paths.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// Random walls, free and unknown cells; thresholds between them.
OccupancyGrid random_grid(int width, int height, double walls, std::uint64_t step) {
  const RandomStream random(2, RandomPurpose::kTest, step);
  std::vector<OccupancyGrid::Cell> cells(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto u = random.uniform4(static_cast<std::uint32_t>(i));
    cells[i] = u[0] < walls ? std::int8_t{66}
                            : (u[1] < 0.3 ? OccupancyGrid::kUnknown : static_cast<std::int8_t>(65 * u[2]));
  }
  return {{width, height, 0.05, {}}, std::move(cells)};
}

void expect_equal(const OccupancyGrid& grid, int far, const std::vector<double>& exact, int threads) {
  const auto fast = truncated_squared_distances(grid, static_cast<std::uint16_t>(far), Executor(threads));
  for (std::size_t i = 0; i < exact.size(); ++i) {
    ASSERT_EQ(fast[i], std::min<double>(exact[i], far))
        << grid.geometry().width << " x " << grid.geometry().height << ", far " << far << ", cell " << i;
  }
}

// Sizes around the lengths of the vectors, a row of many windows, columns through many bands.
TEST(TruncatedSquaredDistances, EqualTheOracleOnEveryPath) {
  std::uint64_t step = 0;
  for (const auto& [width, height, walls] : {std::tuple{1, 1, 1.0},
                                             {1, 1, 0.0},
                                             {31, 33, 0.02},
                                             {64, 64, 0.3},
                                             {65, 127, 0.001},
                                             {2300, 9, 0.0005},
                                             {3, 700, 0.002},
                                             {300, 200, 0.0002}}) {
    const OccupancyGrid grid = random_grid(width, height, walls, step++);
    const std::vector<double> exact = squared_distances(grid);
    test::on_every_simd_path([&](SimdPath) {
      for (const int far : {1, 2, 37, 1600, 254 * 254 + 1, 255 * 255}) expect_equal(grid, far, exact, 1);
    });
  }
}

TEST(TruncatedSquaredDistances, ThreadsChangeNothing) {
  const OccupancyGrid grid = random_grid(2100, 150, 0.0005, 99);
  const std::vector<double> exact = squared_distances(grid);
  for (const int threads : {2, 5}) expect_equal(grid, 1600, exact, threads);
}

TEST(SquaredDistances, AreInfiniteWithoutAWall) {
  for (const double d : squared_distances(random_grid(5, 4, 0.0, 0))) EXPECT_TRUE(std::isinf(d));
}

}  // namespace
}  // namespace cairn
