#include "cairn/maps/visibility.hpp"

#include "cairn/maps/ray_casting.hpp"
#include "random_walls.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// The direction with that turn, of unit length.
Point2 direction_of(double turn) {
  const double s = std::fmod(turn, 2.0) - 1.0, length = std::hypot(1.0, s);
  const Point2 directions[] = {{1, s}, {-s, 1}, {-1, -s}, {s, -1}};
  const Point2 d = directions[static_cast<int>(turn / 2.0)];
  return {d.x / length, d.y / length};
}

const VisiblePiece* piece_at(const std::vector<VisiblePiece>& pieces, double turn) {
  const auto found = std::partition_point(pieces.begin(), pieces.end(),
                                          [&](const VisiblePiece& p) { return p.turn_end <= turn; });
  return found != pieces.end() && found->turn_begin <= turn ? &*found : nullptr;
}

// Every ray ends on the piece that is rendered in its direction.
void expect_what_rays_see(const WallGrid& grid, const Point2& viewpoint,
                          const std::vector<VisiblePiece>& pieces, double reach, int rays) {
  for (int i = 0; i < rays; ++i) {
    const double turn = 8.0 * (i + 0.37) / rays;
    const Point2 u = direction_of(turn);
    const double largest = std::max(std::abs(u.x), std::abs(u.y));
    const RayHit hit = cast_ray(grid, viewpoint, u, reach / largest);
    const VisiblePiece* piece = piece_at(pieces, turn);
    ASSERT_EQ(piece != nullptr, static_cast<bool>(hit)) << "turn " << turn << " at " << viewpoint.x;
    if (piece == nullptr) continue;
    // The point of the piece in that direction.
    const double ax = piece->begin.x - viewpoint.x, ay = piece->begin.y - viewpoint.y;
    const double bx = piece->end.x - viewpoint.x, by = piece->end.y - viewpoint.y;
    const double side_a = u.x * ay - u.y * ax, side_b = u.x * by - u.y * bx;
    const double t = std::clamp(side_a / (side_a - side_b), 0.0, 1.0);
    const double range = std::hypot(ax + t * (bx - ax), ay + t * (by - ay));
    ASSERT_NEAR(range, hit.range_m, 1e-6 * (1.0 + hit.range_m)) << "turn " << turn << " wall " << piece->wall;
  }
}

void expect_in_order(const std::vector<VisiblePiece>& pieces) {
  double before = 0.0;
  for (const VisiblePiece& piece : pieces) {
    ASSERT_LE(before, piece.turn_begin);
    ASSERT_LT(piece.turn_begin, piece.turn_end);
    ASSERT_LE(piece.turn_end, 8.0);
    before = piece.turn_end;
  }
}

TEST(TurnOf, GrowsWithTheAngle) {
  double before = -1.0;
  for (int i = 0; i < 1000; ++i) {
    const double angle = -kPi / 4 + kTwoPi * (i + 0.5) / 1000;
    const double turn = turn_of({3 * std::cos(angle), 3 * std::sin(angle)});
    EXPECT_GT(turn, before);
    EXPECT_LT(turn, 8.0);
    const Point2 back = direction_of(turn);
    EXPECT_NEAR(back.x, std::cos(angle), 1e-12);
    EXPECT_NEAR(back.y, std::sin(angle), 1e-12);
    before = turn;
  }
  EXPECT_EQ(turn_of({1, -1}), 0.0);
  EXPECT_EQ(turn_of({1, 1}), 2.0);
  EXPECT_EQ(turn_of({-1, 1}), 4.0);
  EXPECT_EQ(turn_of({-1, -1}), 6.0);
  EXPECT_TRUE(std::isnan(turn_of({0, 0})));
}

TEST(Visibility, ANearWallHidesPartOfAFarOne) {
  const WallGrid grid(std::make_shared<const VectorMap>(
      std::vector<Wall>{{{4, -4}, {4, 4}}, {{2, -1}, {2, 1}}, {{8, -1}, {8, 1}}}));
  VisibilityRenderer renderer(grid);
  const auto& pieces = renderer.render({0, 0}, 100.0);
  ASSERT_EQ(pieces.size(), 3u);
  EXPECT_EQ(pieces[0].wall, 0u);
  EXPECT_EQ(pieces[1].wall, 1u);
  EXPECT_EQ(pieces[2].wall, 0u);
  EXPECT_NEAR(pieces[0].begin.y, -4.0, 1e-12);
  EXPECT_NEAR(pieces[0].end.y, -2.0, 1e-12) << "hidden from here to 2";
  EXPECT_NEAR(pieces[1].begin.y, -1.0, 1e-12);
  EXPECT_NEAR(pieces[2].begin.y, 2.0, 1e-12);
  EXPECT_NEAR(pieces[2].end.x, 4.0, 1e-12);
}

TEST(Visibility, WallsThatCrossTakeTurns) {
  const WallGrid grid(
      std::make_shared<const VectorMap>(std::vector<Wall>{{{2, -2}, {4, 2}}, {{4, -2}, {2, 2}}}));
  VisibilityRenderer renderer(grid);
  const auto& pieces = renderer.render({0, 0}, 100.0);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces[0].wall, 0u);
  EXPECT_NEAR(pieces[0].end.x, 3.0, 1e-12);
  EXPECT_NEAR(pieces[0].end.y, 0.0, 1e-12);
  EXPECT_EQ(pieces[1].wall, 1u);
}

TEST(Visibility, EqualsDenseRaysAmongWallsThatCross) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const double size = seed % 2 ? 20.0 : 300.0;
    const std::size_t walls = std::size_t{8} << seed;
    const WallGrid grid(std::make_shared<const VectorMap>(test::random_walls(walls, size, size / 6, seed)));
    VisibilityRenderer renderer(grid);
    const RandomStream random(seed, RandomPurpose::kTest, 2);
    for (std::uint32_t i = 0; i < 25; ++i) {
      const auto u = random.uniform4(i);
      const Point2 viewpoint{1.5 * size * (u[0] - 0.5), 1.5 * size * (u[1] - 0.5)};
      const double reach = i % 3 == 0 ? 0.5 * size * u[2] : 1e5;
      const auto& pieces = renderer.render(viewpoint, reach);
      expect_in_order(pieces);
      expect_what_rays_see(grid, viewpoint, pieces, reach, 400);
    }
  }
}

TEST(Visibility, OnAWallAndInACornerIsNoTrouble) {
  const WallGrid grid(std::make_shared<const VectorMap>(
      std::vector<Wall>{{{0, 0}, {4, 0}}, {{4, 0}, {4, 4}}, {{4, 4}, {0, 4}}, {{0, 4}, {0, 0}}}));
  VisibilityRenderer renderer(grid);
  for (const Point2 p : {Point2{2, 0}, Point2{0, 0}, Point2{4, 4}, Point2{4, 2}}) {
    const auto& pieces = renderer.render(p, 100.0);
    expect_in_order(pieces);
    EXPECT_GE(pieces.size(), 2u);
  }
  EXPECT_TRUE(renderer.render({std::nan(""), 0}, 10.0).empty());
  EXPECT_TRUE(renderer.render({1, std::numeric_limits<double>::infinity()}, 10.0).empty());
  EXPECT_TRUE(renderer.render({1, 1}, std::nan("")).empty());
  EXPECT_TRUE(renderer.render({1e15, 1}, 10.0).empty());
  EXPECT_FALSE(renderer.render({2, 2}, std::numeric_limits<double>::infinity()).empty());
}

TEST(Visibility, SeesThroughGlass) {
  const WallGrid grid(std::make_shared<const VectorMap>(
      std::vector<Wall>{{{1, -1}, {1, 1}, Material::kGlass}, {{2, -1}, {2, 1}}}));
  VisibilityRenderer renderer(grid);
  ASSERT_EQ(renderer.render({0, 0}, 9.0).size(), 1u);
  EXPECT_EQ(renderer.render({0, 0}, 9.0).front().wall, 1u);
}

}  // namespace
}  // namespace cairn
