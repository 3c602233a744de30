#pragma once

#include "cairn/maps/triangle_mesh.hpp"

#include <vector>

namespace cairn::test {

/// The cube from 0 to 1, two faces a side, counter-clockwise from outside.
inline TriangleMesh unit_cube() {
  std::vector<Eigen::Vector3d> v;
  for (int i = 0; i < 8; ++i) v.emplace_back(i & 1, (i >> 1) & 1, (i >> 2) & 1);
  return {v,
          {{0, 2, 3},
           {0, 3, 1},
           {4, 5, 7},
           {4, 7, 6},
           {0, 1, 5},
           {0, 5, 4},
           {2, 6, 7},
           {2, 7, 3},
           {0, 4, 6},
           {0, 6, 2},
           {1, 3, 7},
           {1, 7, 5}}};
}

/// A closed body of eight unequal faces whose corners begin anywhere.
inline TriangleMesh lopsided_octahedron() {
  return {{{1.0, 0, 0}, {-0.4, 0, 0}, {0, 1.5, 0}, {0, -0.6, 0}, {0, 0, 0.8}, {0, 0, -2.0}},
          {{0, 2, 4}, {2, 1, 4}, {4, 1, 3}, {0, 4, 3}, {5, 2, 0}, {2, 5, 1}, {1, 5, 3}, {3, 5, 0}}};
}

/// The rectangle from (0, 0) to (3, 2) at z = 1, cut into eight triangles.
inline TriangleMesh flat_rectangle() {
  return {{{0, 0, 1}, {3, 0, 1}, {3, 2, 1}, {0, 2, 1}, {1.2, 0.7, 1}, {2.1, 1.6, 1}, {0.5, 1.5, 1}},
          {{0, 1, 4}, {1, 2, 5}, {4, 1, 5}, {5, 2, 3}, {6, 5, 3}, {4, 5, 6}, {3, 0, 6}, {0, 4, 6}}};
}

}  // namespace cairn::test
