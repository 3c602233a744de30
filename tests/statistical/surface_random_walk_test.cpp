// A random walk over a closed surface leaves a uniform belief uniform, and makes every belief uniform in
// time.
#include "cairn/models/motion/surface_random_walk.hpp"

#include "mini_meshes.hpp"

#include <algorithm>
#include <memory>

#include <gtest/gtest.h>

namespace cairn::test {
namespace {

constexpr std::size_t kPoints = 20'000;

// Each face in three parts of equal area, by the corner that is nearest in weight.
double chi_square(const TriangleMesh& mesh, const std::vector<SurfacePoint>& points) {
  std::vector<double> observed(3 * mesh.size());
  for (const SurfacePoint& p : points) {
    const auto largest = std::max_element(p.weights.begin(), p.weights.end()) - p.weights.begin();
    observed[3 * p.face + static_cast<std::size_t>(largest)] += 1.0;
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    const double expected =
        static_cast<double>(points.size()) * mesh.area(static_cast<std::uint32_t>(i / 3)) / mesh.area() / 3.0;
    sum += (observed[i] - expected) * (observed[i] - expected) / expected;
  }
  return sum;
}

// 23 degrees of freedom: above 73.6 with probability 3.3e-7, three tests.
constexpr double kLargest = 73.6;

std::vector<SurfacePoint> uniform_points(const TriangleMesh& mesh) {
  const RandomStream random(1, RandomPurpose::kInitialize, 0);
  std::vector<SurfacePoint> points;
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    const auto u = random.uniform4(i);
    points.push_back(mesh.at_random(u[0], u[1], u[2]));
  }
  return points;
}

TEST(SurfaceRandomWalk, PointsAtRandomAreUniformOverTheArea) {
  const TriangleMesh mesh = lopsided_octahedron();
  EXPECT_LT(chi_square(mesh, uniform_points(mesh)), kLargest);
}

TEST(SurfaceRandomWalk, AUniformBeliefStaysUniform) {
  const auto mesh = std::make_shared<const TriangleMesh>(lopsided_octahedron());
  const SurfaceRandomWalk model(mesh, 0.7);
  std::vector<SurfacePoint> points = uniform_points(*mesh);
  for (std::uint64_t step = 0; step < 5; ++step)
    model.propagate(1.0, points, RandomStream(2, RandomPurpose::kMotion, step));
  EXPECT_LT(chi_square(*mesh, points), kLargest);
}

TEST(SurfaceRandomWalk, ABeliefAtOnePointBecomesUniform) {
  const auto mesh = std::make_shared<const TriangleMesh>(lopsided_octahedron());
  const SurfaceRandomWalk model(mesh, 1.0);
  std::vector<SurfacePoint> points(kPoints, SurfacePoint{0, {0.2, 0.3, 0.5}});
  model.propagate(0.1, points, RandomStream(3, RandomPurpose::kMotion, 0));
  EXPECT_GT(chi_square(*mesh, points), 1000.0);  // not yet
  for (std::uint64_t step = 1; step < 40; ++step)
    model.propagate(2.0, points, RandomStream(3, RandomPurpose::kMotion, step));
  EXPECT_LT(chi_square(*mesh, points), kLargest);
}

}  // namespace
}  // namespace cairn::test
