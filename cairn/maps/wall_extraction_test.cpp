#include "cairn/maps/wall_extraction.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/maps/wall_drawing.hpp"
#include "mini_maps.hpp"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using ::testing::HasSubstr;

double distance_to_nearest(const VectorMap& map, const Point2& p) {
  double nearest = 1e9;
  for (const Wall& wall : map.walls()) nearest = std::min(nearest, distance(p, wall));
  return nearest;
}

// A room of 9 m x 6 m turned by 20 degrees, with a wall that stands in it.
VectorMap turned_room() {
  const Pose2 T{1.0, 2.0, 20.0 * kPi / 180.0};
  const Point2 c[] = {T * Point2{0, 0}, T * Point2{9, 0}, T * Point2{9, 6}, T * Point2{0, 6}};
  return VectorMap(
      {{c[0], c[1]}, {c[1], c[2]}, {c[2], c[3]}, {c[3], c[0]}, {T * Point2{3, 2}, T * Point2{6, 2.5}}});
}

TEST(WallDrawing, DrawsWallsAndWhatTheyEnclose) {
  const VectorMap room({{{0, 0}, {4, 0}},
                        {{4, 0}, {4, 3}},
                        {{4, 3}, {0, 3}},
                        {{0, 3}, {0, 0}},
                        {{2, 0.1}, {2, 2.9}, Material::kGlass}});
  const OccupancyGrid grid = draw_walls(room, {.resolution_m = 0.1});
  EXPECT_EQ(grid.count(CellState::kOccupied), 2u * (41 + 31) - 4);
  EXPECT_EQ(grid.count(CellState::kFree), 39u * 29);
  EXPECT_EQ(grid.state_at({0, 0}), CellState::kOccupied);
  EXPECT_EQ(grid.state_at({2, 1}), CellState::kFree) << "glass is not drawn";
  EXPECT_EQ(grid.state_at({-0.2, 1}), CellState::kUnknown);
  const OccupancyGrid from_outside = draw_walls(room, {.resolution_m = 0.1, .inside = {{-0.3, 0}}});
  EXPECT_EQ(from_outside.state_at({-0.2, 1}), CellState::kFree);
  EXPECT_EQ(from_outside.state_at({2, 1}), CellState::kUnknown);
}

TEST(WallDrawing, HasNoGapsAtAnyAngle) {
  for (int i = 0; i < 90; ++i) {
    const double a = i * kPi / 180.0;
    const auto corner = [&](int k) {
      return Point2{3 * std::cos(a + k * kPi / 2), 3 * std::sin(a + k * kPi / 2)};
    };
    std::vector<Wall> walls;
    for (int k = 0; k < 4; ++k) walls.push_back({corner(k), corner(k + 1)});
    const OccupancyGrid grid = draw_walls(VectorMap(walls), {.resolution_m = 0.07});
    EXPECT_EQ(grid.state_at({0, 0}), CellState::kFree) << i;
    EXPECT_NEAR(static_cast<double>(grid.count(CellState::kFree)) * 0.07 * 0.07, 18.0, 1.2) << i;
  }
}

TEST(WallDrawing, RefusesWhatCannotBeDrawn) {
  const auto error_of = [](const WallDrawingOptions& options) -> std::string {
    try {
      draw_walls(turned_room(), options);
    } catch (const ConfigurationError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(error_of({.resolution_m = 0.0}), HasSubstr("is not positive"));
  EXPECT_THAT(error_of({.resolution_m = std::nan("")}), HasSubstr("is not positive"));
  EXPECT_THAT(error_of({.resolution_m = 1e-5}), HasSubstr("2^30"));
  EXPECT_THAT(error_of({.inside = {{1e3, 0}}}), HasSubstr("lies off the map"));
  EXPECT_THAT(error_of({.inside = {{1.0, 2.0}}}), HasSubstr("lies in a wall"));
  EXPECT_THAT(error_of({.inside = {{std::nan(""), 2.0}}}), HasSubstr("lies off the map"));
}

TEST(WallExtraction, FindsTheWallsThatWereDrawn) {
  const VectorMap room = turned_room();
  const OccupancyGrid grid = draw_walls(room, {.resolution_m = 0.05});
  const VectorMap found = extract_walls(grid);
  EXPECT_LE(found.walls().size(), 8u);
  EXPECT_NEAR(found.length_m(), room.length_m(), 0.5);
  for (const Wall& wall : found.walls()) {  // exactly on the walls, well below a cell
    EXPECT_LT(distance_to_nearest(room, wall.a), 0.06);
    EXPECT_LT(distance_to_nearest(room, {(wall.a.x + wall.b.x) / 2, (wall.a.y + wall.b.y) / 2}), 0.01);
  }
  for (const Wall& wall : room.walls()) {
    for (int i = 0; i <= 20; ++i) {
      const double t = i / 20.0;
      const Point2 p{wall.a.x + t * (wall.b.x - wall.a.x), wall.a.y + t * (wall.b.y - wall.a.y)};
      EXPECT_LT(distance_to_nearest(found, p), 0.08);
    }
  }
}

TEST(WallExtraction, FollowsTheSurfaceOfSolidBlocksAndMovesWithTheGrid) {
  const Pose2 T{3.0, -2.0, 0.7};
  const VectorMap here = extract_walls(test::mini_room()), moved = extract_walls(test::mini_room(T));
  ASSERT_EQ(here.walls().size(), moved.walls().size());
  for (std::size_t i = 0; i < here.walls().size(); ++i) {
    const Point2 p = T * here.walls()[i].a;
    EXPECT_NEAR(p.x, moved.walls()[i].a.x, 1e-9);
    EXPECT_NEAR(p.y, moved.walls()[i].a.y, 1e-9);
  }
  // Left side of the niche's block, cells from 110 on; every side of the small pillars.
  EXPECT_LT(distance_to_nearest(here, {5.525, 4.0}), 0.01);
  EXPECT_LT(distance_to_nearest(here, {1.525, 3.65}), 0.03);
  EXPECT_LT(distance_to_nearest(here, {3.525, 1.25}), 0.03);
  EXPECT_LT(distance_to_nearest(here, {0.6, 2.05}), 0.03);
}

TEST(WallExtraction, RefusesAGridWithoutWalls) {
  EXPECT_THROW(extract_walls(test::draw_grid({"   ", " # ", "   "})), InputError);
  EXPECT_THROW(extract_walls(test::draw_grid({"???", "###"})), InputError);
}

}  // namespace
}  // namespace cairn
