#include "cairn/maps/surface_walk.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/rng.hpp"
#include "mini_meshes.hpp"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace cairn::test {
namespace {

const RandomStream kRandom(1, RandomPurpose::kTest, 0);

SurfacePoint random_point(const TriangleMesh& mesh, std::uint32_t i) {
  const auto u = kRandom.uniform4(i);
  return mesh.at_random(u[0], u[1], u[2]);
}

Eigen::Vector2d random_step(std::uint32_t i, double sigma_m) {
  const auto n = kRandom.normal4(i, 1);
  return {sigma_m * n[0], sigma_m * n[1]};
}

// A step in a face's frame, in the frame of the vertices.
Eigen::Vector3d in_space(const TriangleMesh& mesh, std::uint32_t face, const Eigen::Vector2d& step) {
  const auto& corners = mesh.face(face);
  const Eigen::Vector3d x = (mesh.vertices()[corners[1]] - mesh.vertices()[corners[0]]).normalized();
  return step.x() * x + step.y() * mesh.normal(face).cross(x);
}

Eigen::Vector2d in_face(const TriangleMesh& mesh, std::uint32_t face, const Eigen::Vector3d& step) {
  return {step.dot(in_space(mesh, face, {1.0, 0.0})), step.dot(in_space(mesh, face, {0.0, 1.0}))};
}

void expect_on_surface(const TriangleMesh& mesh, const SurfacePoint& p) {
  ASSERT_LT(p.face, mesh.size());
  for (const double w : p.weights) ASSERT_TRUE(w >= 0.0 && w <= 1.0) << w;
  ASSERT_NEAR(p.weights[0] + p.weights[1] + p.weights[2], 1.0, 1e-12);
}

TEST(SurfaceWalk, StaysOnTheSurface) {
  for (const TriangleMesh& mesh : {unit_cube(), lopsided_octahedron(), flat_rectangle()}) {
    for (std::uint32_t i = 0; i < 2000; ++i) {
      const Eigen::Vector2d step = random_step(i, i % 2 == 0 ? 0.3 : 30.0);
      const WalkEnd end = walk(mesh, random_point(mesh, i), step);
      expect_on_surface(mesh, end.point);
      ASSERT_NEAR(end.step.norm(), step.norm(), 1e-9 * step.norm());
    }
  }
}

TEST(SurfaceWalk, LeadsBack) {
  for (const TriangleMesh& mesh : {unit_cube(), lopsided_octahedron(), flat_rectangle()}) {
    for (std::uint32_t i = 0; i < 500; ++i) {
      const SurfacePoint start = random_point(mesh, i);
      const Eigen::Vector2d step = random_step(i, 2.0);
      const WalkEnd there = walk(mesh, start, step);
      const WalkEnd back = walk(mesh, there.point, -there.step);
      ASSERT_LT((mesh.position(back.point) - mesh.position(start)).norm(), 1e-9) << i;
      ASSERT_EQ(back.point.face, start.face);
      ASSERT_LT((back.step + step).norm(), 1e-9) << i;
    }
  }
}

// 0 to `size`, back and forth.
double mirrored(double x, double size) { return std::abs(std::remainder(x, 2.0 * size)); }

TEST(SurfaceWalk, OnAFlatMeshItIsAStraightLineThatTheBorderReflects) {
  const TriangleMesh mesh = flat_rectangle();
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const SurfacePoint start = random_point(mesh, i);
    const Eigen::Vector2d step = random_step(i, 2.0);
    const Eigen::Vector3d straight = mesh.position(start) + in_space(mesh, start.face, step);
    const Eigen::Vector3d end = mesh.position(walk(mesh, start, step).point);
    EXPECT_NEAR(end.x(), mirrored(straight.x(), 3.0), 1e-9);
    EXPECT_NEAR(end.y(), mirrored(straight.y(), 2.0), 1e-9);
    EXPECT_DOUBLE_EQ(end.z(), 1.0);
  }
}

// Faces 2 and 3 of the cube are its top, at z = 1.
TEST(SurfaceWalk, OverTheEdgesOfACube) {
  const TriangleMesh cube = unit_cube();
  const SurfacePoint start{2, {0.2, 0.5, 0.3}};  // at (0.8, 0.3, 1): corners (0,0), (1,0), (1,1)
  ASSERT_LT((cube.position(start) - Eigen::Vector3d(0.8, 0.3, 1.0)).norm(), 1e-12);
  const auto end_of = [&](double x, double y) {
    return cube.position(walk(cube, start, in_face(cube, 2, {x, y, 0.0})).point);
  };
  EXPECT_LT((end_of(0.5, 0.0) - Eigen::Vector3d(1.0, 0.3, 0.7)).norm(), 1e-12);   // down the side x = 1
  EXPECT_LT((end_of(-1.0, 0.0) - Eigen::Vector3d(0.0, 0.3, 0.8)).norm(), 1e-12);  // down the side x = 0
  EXPECT_LT((end_of(0.0, 2.0) - Eigen::Vector3d(0.8, 0.7, 0.0)).norm(), 1e-12);   // to the bottom
  EXPECT_LT((end_of(4.0, 0.0) - Eigen::Vector3d(0.8, 0.3, 1.0)).norm(), 1e-12);   // once around
  EXPECT_LT((end_of(0.4, 0.4) - Eigen::Vector3d(1.0, 0.7, 0.8)).norm(), 1e-12);   // slanting
  EXPECT_LT((end_of(0.0, 0.0) - Eigen::Vector3d(0.8, 0.3, 1.0)).norm(), 1e-12);
}

TEST(SurfaceWalk, IntoCornersAndAlongEdges) {
  for (const TriangleMesh& mesh : {unit_cube(), lopsided_octahedron(), flat_rectangle()}) {
    for (std::uint32_t f = 0; f < mesh.size(); ++f) {
      for (int k = 0; k < 3; ++k) {
        const SurfacePoint middle{f, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}};
        const Eigen::Vector2d centre = (mesh.corner(f, 0) + mesh.corner(f, 1) + mesh.corner(f, 2)) / 3.0;
        SurfacePoint corner{f, {0.0, 0.0, 0.0}};
        corner.weights[static_cast<std::size_t>(k)] = 1.0;
        const Eigen::Vector2d edge = mesh.corner(f, (k + 1) % 3) - mesh.corner(f, k);
        for (const double far : {0.5, 1.0, 1.5, 10.0}) {
          expect_on_surface(mesh, walk(mesh, middle, far * (mesh.corner(f, k) - centre)).point);
          expect_on_surface(mesh, walk(mesh, corner, far * edge).point);
          expect_on_surface(mesh, walk(mesh, corner, -far * edge).point);
          expect_on_surface(mesh, walk(mesh, corner, far * (mesh.corner(f, k) - centre)).point);
        }
      }
    }
  }
}

}  // namespace
}  // namespace cairn::test
