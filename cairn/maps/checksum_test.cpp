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

}  // namespace
}  // namespace cairn
