#include "cairn/sim/route_planner.hpp"

#include "mini_maps.hpp"
#include "small_world.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// A wall from the left to x = 6 divides the room: the only way leads around its end.
World divided_room() {
  WorldOptions options = test::small_world_options();
  options.walls.push_back({"divider", "0,3 6,3", false, "opaque", true});
  return make_world(options);
}

double length(Point2 from, const std::vector<Point2>& way) {
  double sum = 0.0;
  for (const Point2& p : way) {
    sum += std::hypot(p.x - from.x, p.y - from.y);
    from = p;
  }
  return sum;
}

TEST(RoutePlanner, StraightWhereNothingIsBetween) {
  const World world = divided_room();
  const auto way = world.planner.route({1.0, 1.0}, {5.0, 2.0});
  ASSERT_TRUE(way);
  EXPECT_EQ(way->size(), 1U);
}

TEST(RoutePlanner, AroundAWallByTheShortestWay) {
  const World world = divided_room();
  const Point2 from{1.0, 1.0}, to{1.0, 5.0};
  const auto way = world.planner.route(from, to);
  ASSERT_TRUE(way);
  EXPECT_EQ(way->back(), to);
  Point2 at = from;
  for (const Point2& corner : *way) {
    EXPECT_TRUE(world.planner.sees(at, corner));
    at = corner;
  }
  // Around a disc of the clearance (0.37 m) at the wall's end; the grid adds a little.
  const double shortest = 2.0 * std::hypot(5.0, 2.0);
  EXPECT_GT(length(from, *way), shortest);
  EXPECT_LT(length(from, *way), shortest + 1.2);
}

TEST(RoutePlanner, KeepsItsClearance) {
  const World world = divided_room();
  EXPECT_FALSE(world.planner.is_free({3.0, 2.7}));
  EXPECT_TRUE(world.planner.is_free({3.0, 2.5}));
  EXPECT_FALSE(world.planner.is_free({-3.0, 2.0})) << "outside";
  EXPECT_FALSE(world.planner.sees({1.0, 1.0}, {1.0, 5.0}));
}

TEST(RoutePlanner, NoWayIsToldAsSuch) {
  WorldOptions options = test::small_world_options();
  options.walls.push_back({"divider", "0,3 8,3", false, "opaque", true});
  const World world = make_world(options);
  EXPECT_FALSE(world.planner.route({1.0, 1.0}, {1.0, 5.0}));
  EXPECT_FALSE(world.planner.route({1.0, 1.0}, {0.0, 1.0}));
}

// The robot could stand in both rooms; the gap between them is too narrow for it.
TEST(RoutePlanner, JoinsWhatAWayLeadsBetween) {
  std::vector<std::string> lines(40, std::string(20, ' ') + "#" + std::string(19, ' '));
  for (const std::size_t row : {18u, 19u}) lines[row] = std::string(40, ' ');
  const RoutePlanner planner(test::draw_grid(lines, 0.1), 0.3);
  const Point2 left{1.0, 1.0}, right{3.0, 1.0};
  EXPECT_TRUE(planner.is_free(left) && planner.is_free(right));
  EXPECT_FALSE(planner.joins(left, right));
  EXPECT_FALSE(planner.route(left, right));
  EXPECT_TRUE(planner.joins(left, {0.5, 3.5}));
  EXPECT_FALSE(planner.joins(left, {2.05, 1.0})) << "in the wall";
  const RoutePlanner small(test::draw_grid(lines, 0.1), 0.05);
  EXPECT_TRUE(small.joins(left, right));
  EXPECT_TRUE(small.route(left, right));
}

}  // namespace
}  // namespace cairn
