#include "cairn/maps/checksum.hpp"

#include <set>

#include <gtest/gtest.h>

namespace cairn {
namespace {

std::uint64_t of(const GridGeometry& geometry, std::vector<OccupancyGrid::Cell> cells) {
  return checksum(OccupancyGrid(geometry, std::move(cells)));
}

TEST(Checksum, TellsMapsApart) {
  const std::set<std::uint64_t> sums = {
      of({2, 1, 0.05, {0, 0, 0}}, {0, 100}),    of({2, 1, 0.05, {0, 0, 0}}, {100, 0}),
      of({2, 1, 0.05, {0, 0, 0}}, {0, -1}),     of({1, 2, 0.05, {0, 0, 0}}, {0, 100}),
      of({2, 1, 0.1, {0, 0, 0}}, {0, 100}),     of({2, 1, 0.05, {1, 0, 0}}, {0, 100}),
      of({2, 1, 0.05, {0, 1e-9, 0}}, {0, 100}), of({2, 1, 0.05, {0, 0, 0.1}}, {0, 100})};
  EXPECT_EQ(sums.size(), 8u);
}

TEST(Checksum, DependsOnStatesOnly) {
  EXPECT_EQ(of({2, 1, 0.05, {0, 0, 0}}, {0, 100}), of({2, 1, 0.05, {-0.0, 0, 0}}, {10, 70}));
}

TEST(Checksum, OfASetCoversTheWallsToo) {
  const auto grid = std::make_shared<const OccupancyGrid>(GridGeometry{2, 1, 0.05, {0, 0, 0}},
                                                          std::vector<OccupancyGrid::Cell>{0, 100});
  const auto with_wall = [&](double x) {
    MapSet maps(grid);
    maps.add(std::make_shared<const VectorMap>(std::vector<Wall>{{{0.0, 0.0}, {x, 0.0}}}));
    return checksum(maps);
  };
  EXPECT_EQ(checksum(MapSet(grid)), checksum(*grid));
  EXPECT_EQ(with_wall(1.0), with_wall(1.0));
  EXPECT_NE(with_wall(1.0), with_wall(1.001)) << "less than a cell, but another map";
  EXPECT_NE(with_wall(1.0), checksum(*grid));
}

TEST(Checksum, OfASetCoversTheNormalDistributionsToo) {
  const auto grid = std::make_shared<const OccupancyGrid>(GridGeometry{2, 1, 0.05, {0, 0, 0}},
                                                          std::vector<OccupancyGrid::Cell>{0, 100});
  const auto with_ndt = [&](double x) {
    const std::vector<Point2> points{{x, 0.1}, {x + 0.1, 0.1}, {x + 0.2, 0.15}};
    MapSet maps(grid);
    maps.add(std::make_shared<const NdtMap>(ndt_from_points(points, {})));
    return checksum(maps);
  };
  EXPECT_EQ(with_ndt(0.1), with_ndt(0.1));
  EXPECT_NE(with_ndt(0.1), with_ndt(0.101));
  EXPECT_NE(with_ndt(0.1), checksum(*grid));
}

}  // namespace
}  // namespace cairn
