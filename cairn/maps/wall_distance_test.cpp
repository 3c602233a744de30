#include "cairn/maps/wall_distance.hpp"

#include "cairn/core/errors.hpp"
#include "random_walls.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(WallDistance, EqualsBruteForce) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const double size = seed % 2 ? 15.0 : 200.0;
    const auto map = std::make_shared<const VectorMap>(test::random_walls(20 << seed, size, size / 6, seed));
    const WallDistance field(map, 2.0);
    const RandomStream random(seed, RandomPurpose::kTest, 3);
    int found = 0;
    for (std::uint32_t i = 0; i < 2000; ++i) {
      const auto u = random.uniform4(i);
      const Point2 p{1.5 * size * (u[0] - 0.5), 1.5 * size * (u[1] - 0.5)};
      double smallest = 1e9;
      for (const Wall& wall : map->walls()) {
        if (wall.material == Material::kOpaque) smallest = std::min(smallest, distance(p, wall));
      }
      const auto nearest = field.nearest(p);
      ASSERT_EQ(nearest.has_value(), smallest <= 2.0) << smallest;
      if (!nearest) continue;
      ASSERT_NEAR(std::hypot(nearest->x - p.x, nearest->y - p.y), smallest, 1e-12);
      ++found;
    }
    EXPECT_GT(found, 100);
  }
}

TEST(WallDistance, FarAwayAndNotANumberAreNone) {
  const auto map = std::make_shared<const VectorMap>(std::vector<Wall>{{{0, 0}, {1e6, 3}}});
  const WallDistance field(map, 1.0);
  for (const double bad : {std::nan(""), 1e300, -1e300, HUGE_VAL, -HUGE_VAL}) {
    EXPECT_FALSE(field.nearest({bad, 0}));
    EXPECT_FALSE(field.nearest({0, bad}));
  }
  EXPECT_TRUE(field.nearest({5e5, 2.0}));
  EXPECT_FALSE(field.nearest({5e5, 3.0}));
  EXPECT_THROW(WallDistance(map, 0.0), ConfigurationError);
  EXPECT_THROW(WallDistance(map, std::nan("")), ConfigurationError);
}

}  // namespace
}  // namespace cairn
