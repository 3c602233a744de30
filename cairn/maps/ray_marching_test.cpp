#include "cairn/maps/ray_marching.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/core/rng.hpp"
#include "mini_maps.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(RayMarcher, RefusesARangeThatIsNotPositive) {
  const OccupancyGrid room = test::mini_room();
  for (const double range : {0.0, -1.0, std::nan("")})
    EXPECT_THROW(RayMarcher(room, range), ConfigurationError) << range;
}

}  // namespace
}  // namespace cairn
