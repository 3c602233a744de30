#include "cairn/models/motion/surface_random_walk.hpp"

#include "cairn/core/errors.hpp"
#include "mini_meshes.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn::test {
namespace {

const RandomStream kRandom(1, RandomPurpose::kTest, 0);

TEST(SurfaceRandomWalk, TheSpreadGrowsWithTheRootOfTheTime) {
  const auto mesh = std::make_shared<const TriangleMesh>(flat_rectangle());
  const SurfacePoint start{5, {0.4, 0.3, 0.3}};
  for (const double seconds : {1.0, 4.0}) {
    std::vector<SurfacePoint> points(20'000, start);
    SurfaceRandomWalk(mesh, 0.05).propagate(seconds, points, kRandom);
    double squares = 0.0;
    for (const SurfacePoint& p : points)
      squares += (mesh->position(p) - mesh->position(start)).squaredNorm() / 2.0 / 20'000;
    const double variance = 0.05 * 0.05 * seconds;  // per axis; 4.9 standard errors of 40,000 squares
    EXPECT_NEAR(squares, variance, 4.9 * variance * std::sqrt(2.0 / 40'000));
  }
}

TEST(SurfaceRandomWalk, IndependentOfChunksAndStillWithoutTime) {
  const auto mesh = std::make_shared<const TriangleMesh>(unit_cube());
  const SurfaceRandomWalk model(mesh, 0.5);
  const std::vector<SurfacePoint> start(100, SurfacePoint{3, {0.1, 0.2, 0.7}});
  auto whole = start, pieces = start, still = start;
  model.propagate(1.0, whole, kRandom);
  for (std::uint32_t i = 0; i < 100; i += 20)
    model.propagate(1.0, std::span(pieces).subspan(i, 20), kRandom.from_item(i));
  EXPECT_EQ(whole, pieces);
  EXPECT_NE(whole[0], whole[1]);
  model.propagate(0.0, still, kRandom);
  model.propagate(-1.0, still, kRandom);
  for (const SurfacePoint& p : still) EXPECT_NEAR(p.weights[2], 0.7, 1e-15);
}

TEST(SurfaceRandomWalk, RefusesWhatIsNoStandardDeviation) {
  const auto mesh = std::make_shared<const TriangleMesh>(unit_cube());
  EXPECT_THROW(SurfaceRandomWalk(mesh, -0.1), ConfigurationError);
  EXPECT_THROW(SurfaceRandomWalk(mesh, std::nan("")), ConfigurationError);
}

}  // namespace
}  // namespace cairn::test
