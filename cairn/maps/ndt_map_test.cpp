#include "cairn/maps/ndt_map.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/core/rng.hpp"
#include "mini_maps.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// The distribution of a layer at a point of the map; none: one without points.
NdtCell cell_at(const NdtMap& map, int layer, const Point2& p_map) {
  const auto found = map.around(inverse(map.geometry().T_map_ndt) * p_map)[static_cast<std::size_t>(layer)];
  return found == NdtMap::kNone ? NdtCell{} : map.cells()[static_cast<std::size_t>(found)];
}

std::vector<Point2> straight_wall() {
  std::vector<Point2> points;
  for (int i = 0; i < 400; ++i) points.push_back({0.005 + 0.01 * i, 1.25});
  return points;
}

TEST(NdtMap, ACellHoldsMeanAndCovarianceOfItsPoints) {
  const RandomStream random(5, RandomPurpose::kTest, 0);
  std::vector<Point2> points;
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::uint32_t i = 0; i < 50; ++i) {
    const auto u = random.uniform4(i);
    points.push_back({1.0 + 0.49 * u[0], 2.0 + 0.49 * u[1] * u[0]});
    x += points.back().x / 50, y += points.back().y / 50;
  }
  for (const Point2& p : points) {
    xx += (p.x - x) * (p.x - x) / 50, xy += (p.x - x) * (p.y - y) / 50, yy += (p.y - y) * (p.y - y) / 50;
  }
  const NdtMap map = ndt_from_points(points, {.noise_m = 0.01});
  const NdtCell cell = cell_at(map, 0, {1.2, 2.2});
  EXPECT_EQ(cell.points, 50.0);
  EXPECT_NEAR(cell.mean.x + map.geometry().T_map_ndt.x, x, 1e-12);
  EXPECT_NEAR(cell.mean.y + map.geometry().T_map_ndt.y, y, 1e-12);
  EXPECT_NEAR(cell.xx, xx + 1e-4, 1e-12);
  EXPECT_NEAR(cell.xy, xy, 1e-12);
  EXPECT_NEAR(cell.yy, yy + 1e-4, 1e-12);
}

TEST(NdtMap, EveryPointLiesInFourCells) {
  const NdtMap map = ndt_from_points(straight_wall(), {});
  for (const double x : {0.6, 1.0, 1.4, 2.25}) {
    for (int layer = 0; layer < NdtGeometry::kLayers; ++layer) {
      EXPECT_NEAR(cell_at(map, layer, {x, 1.25}).mean.y + map.geometry().T_map_ndt.y, 1.25, 1e-9);
    }
  }
  EXPECT_NE(cell_at(map, 0, {1.1, 1.25}).mean.x, cell_at(map, 1, {1.1, 1.25}).mean.x);
  EXPECT_EQ(cell_at(map, 0, {1.0, 9.0}).points, 0.0);
  EXPECT_EQ(cell_at(map, 0, {std::nan(""), 1.0}).points, 0.0);
}

TEST(NdtMap, OfAGridIsThatOfItsOccupiedCells) {
  const Pose2 T_map_grid{3.0, -2.0, 0.5};
  const NdtMap map =
      ndt_from_grid(test::draw_grid({"    ", "####", "    "}, 0.1, T_map_grid), {.noise_m = 0.0});
  const NdtCell cell = cell_at(map, 0, T_map_grid * Point2{0.2, 0.15});
  EXPECT_EQ(cell.points, 4.0);
  EXPECT_NEAR(cell.mean.x, 0.2, 1e-12);
  EXPECT_NEAR(cell.mean.y, 0.15, 1e-12);
  EXPECT_NEAR(cell.yy, 0.01 / 12.0, 1e-9);  // a cell is a square
  EXPECT_EQ(cell.occupancy, 1.0);
}

TEST(NdtMap, OccupancyIsTheShareOfBeamsThatEndThere) {
  // Three quarters of the beams end at a curtain at x = 1.25, the rest go on to the wall at x = 3.25.
  std::vector<NdtScan> scans;
  for (int i = 0; i < 40; ++i) {
    NdtScan scan{{0.0, 0.01 * i, 0.0}, {}};
    scan.end_points.push_back({i % 4 == 0 ? 3.25 : 1.25, 0.0});
    scans.push_back(scan);
  }
  const NdtMap map = ndt_from_scans(scans, {});
  EXPECT_NEAR(cell_at(map, 0, {1.25, 0.2}).occupancy, 0.75, 1e-12);
  EXPECT_EQ(cell_at(map, 0, {3.25, 0.2}).occupancy, 1.0);
}

TEST(NdtMap, ABeamAlongAWallDoesNotSpeakAgainstIt) {
  std::vector<NdtScan> scans;
  for (int i = 0; i < 30; ++i) scans.push_back({{0.1 * i, 1.0, 0.0}, {{0.0, 0.45}}});
  scans.push_back(
      {{0.0, 1.2, 0.0}, {{3.0, 0.0}, {3.0, 0.0}, {3.0, 0.0}}});  // 25 cm beside the wall at y = 1.45
  const NdtMap map = ndt_from_scans(scans, {});
  EXPECT_EQ(cell_at(map, 0, {1.6, 1.45}).occupancy, 1.0);
}

TEST(NdtMap, RefusesBadInput) {
  EXPECT_THROW(ndt_from_points({}, {}), InputError);
  EXPECT_THROW(ndt_from_points(std::vector<Point2>{{0, std::nan("")}}, {}), InputError);
  EXPECT_THROW(ndt_from_points(straight_wall(), {.cell_size_m = 0.0}), InputError);
  EXPECT_THROW(ndt_from_points(std::vector<Point2>{{0, 0}, {1e9, 1e9}}, {}), InputError);
  EXPECT_THROW(ndt_from_grid(test::draw_grid({"  "}), {}), InputError);
  const NdtGeometry geometry{{}, 0.5, 2, 2};
  EXPECT_THROW(NdtMap(geometry, {{.index = 99, .xx = 1.0, .yy = 1.0}}), InputError);
  EXPECT_THROW(NdtMap(geometry, {{.index = 1, .xx = 1.0, .xy = 2.0, .yy = 1.0}}), InputError);
  EXPECT_THROW(NdtMap(geometry, {{.index = 1, .xx = 1.0, .yy = 1.0, .occupancy = 1.5}}), InputError);
  EXPECT_THROW(NdtMap(geometry, {{.index = 1, .xx = 1.0, .yy = 1.0}, {.index = 1, .xx = 1.0, .yy = 1.0}}),
               InputError);
}

}  // namespace
}  // namespace cairn
