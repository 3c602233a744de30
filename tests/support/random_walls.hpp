#pragma once

#include "cairn/core/angle.hpp"
#include "cairn/core/rng.hpp"
#include "cairn/maps/vector_map.hpp"

#include <cmath>
#include <vector>

namespace cairn::test {

/// `n` walls of up to `length_m` anywhere in a square of `size_m` around the origin: they cross, and every
/// fourth begins where the last one ends. Every tenth is of glass.
inline VectorMap random_walls(std::size_t n, double size_m, double length_m, std::uint64_t seed) {
  const RandomStream random(seed, RandomPurpose::kTest, 0);
  std::vector<Wall> walls;
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto u = random.uniform4(i);
    Point2 a{size_m * (u[0] - 0.5), size_m * (u[1] - 0.5)};
    if (i % 4 == 3) a = walls.back().b;
    const double angle = i % 3 == 0 ? kPi / 2 * std::floor(4 * u[2]) : kTwoPi * u[2];
    const double length = length_m * u[3] + 1e-3;
    walls.push_back({a,
                     {a.x + length * std::cos(angle), a.y + length * std::sin(angle)},
                     i % 10 == 9 ? Material::kGlass : Material::kOpaque});
  }
  return VectorMap(std::move(walls));
}

}  // namespace cairn::test
