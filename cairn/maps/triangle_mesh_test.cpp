#include "cairn/maps/triangle_mesh.hpp"

#include "cairn/core/errors.hpp"
#include "mini_meshes.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace cairn::test {
namespace {

TEST(TriangleMesh, MeasuresOfACube) {
  const TriangleMesh cube = unit_cube();
  EXPECT_EQ(cube.size(), 12u);
  EXPECT_DOUBLE_EQ(cube.area(), 6.0);
  EXPECT_TRUE(cube.is_closed());
  for (std::uint32_t f = 0; f < 12; ++f) {
    EXPECT_DOUBLE_EQ(cube.area(f), 0.5);
    // Outwards: away from the middle.
    const Eigen::Vector3d middle = cube.position({f, {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}});
    EXPECT_GT(cube.normal(f).dot(middle - Eigen::Vector3d(0.5, 0.5, 0.5)), 0.49);
  }
}

TEST(TriangleMesh, NeighboursNameEachOtherAndTheSameEdge) {
  for (const TriangleMesh& mesh : {unit_cube(), lopsided_octahedron(), flat_rectangle()}) {
    int borders = 0;
    for (std::uint32_t f = 0; f < mesh.size(); ++f) {
      for (int k = 0; k < 3; ++k) {
        const auto other = mesh.across(f, k);
        if (!other) {
          ++borders;
          continue;
        }
        const auto back = mesh.across(other->face, other->edge);
        ASSERT_TRUE(back);
        EXPECT_EQ(back->face, f);
        EXPECT_EQ(back->edge, k);
        EXPECT_EQ(mesh.face(f)[(k + 1) % 3], mesh.face(other->face)[(other->edge + 2) % 3]);
        EXPECT_EQ(mesh.face(f)[(k + 2) % 3], mesh.face(other->face)[(other->edge + 1) % 3]);
      }
    }
    EXPECT_EQ(borders, mesh.is_closed() ? 0 : 4);
  }
}

TEST(TriangleMesh, TheFrameOfAFaceKeepsDistances) {
  const TriangleMesh mesh = lopsided_octahedron();
  for (std::uint32_t f = 0; f < mesh.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      EXPECT_NEAR((mesh.corner(f, k) - mesh.corner(f, next)).norm(),
                  (mesh.vertices()[mesh.face(f)[k]] - mesh.vertices()[mesh.face(f)[next]]).norm(), 1e-14);
    }
    EXPECT_GT(mesh.corner(f, 2).y(), 0.0);
  }
}

TEST(TriangleMesh, RandomPointsAtTheEdgesOfTheirNumbers) {
  const TriangleMesh mesh = lopsided_octahedron();
  for (const double u : {1e-10, 0.5, 1.0 - 1e-10, 1.0}) {
    const SurfacePoint p = mesh.at_random(u, u, u);
    EXPECT_LT(p.face, mesh.size());
    EXPECT_NEAR(p.weights[0] + p.weights[1] + p.weights[2], 1.0, 1e-15);
    for (const double w : p.weights) EXPECT_GE(w, 0.0);
  }
}

TEST(TriangleMesh, WhatIsNoSurfaceIsRefused) {
  using Faces = std::vector<TriangleMesh::Face>;
  const std::vector<Eigen::Vector3d> v = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 0}};
  auto not_finite = v;
  not_finite[1].x() = std::numeric_limits<double>::quiet_NaN();
  auto huge = v;
  huge[1].x() = 1e300;
  EXPECT_THROW(TriangleMesh(v, {}), InputError);
  EXPECT_THROW(TriangleMesh(v, Faces{{0, 1, 5}}), InputError);
  EXPECT_THROW(TriangleMesh(v, Faces{{0, 1, 1}}), InputError);
  EXPECT_THROW(TriangleMesh(v, Faces{{0, 1, 4}}), InputError);                        // in a line
  EXPECT_THROW(TriangleMesh(v, Faces{{0, 1, 2}, {0, 1, 3}}), InputError);             // opposite sides
  EXPECT_THROW(TriangleMesh(v, Faces{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), InputError);  // also in a line
  EXPECT_THROW(TriangleMesh(v, Faces{{0, 1, 2}, {1, 0, 3}, {1, 0, 2}}), InputError);  // three at an edge
  EXPECT_THROW(TriangleMesh(not_finite, Faces{{0, 1, 2}}), InputError);
  EXPECT_THROW(TriangleMesh(huge, Faces{{0, 1, 2}}), InputError);
  try {
    TriangleMesh(v, Faces{{0, 1, 2}, {1, 0, 9}}, "hull");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.where(), "hull: face 1");
  }
}

}  // namespace
}  // namespace cairn::test
