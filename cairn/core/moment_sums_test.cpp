#include "cairn/core/moment_sums.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/rng.hpp"
#include "cairn/core/statistics.hpp"
#include "simd_paths.hpp"

#include <cmath>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

struct Weighted {
  std::vector<Pose2> poses;
  std::vector<double> weights;
};

// Headings around +-pi, so that the turns wrap.
Weighted some_poses(std::size_t n) {
  const RandomStream random(4, RandomPurpose::kTest, 0);
  Weighted made;
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto g = random.normal4(i);
    made.poses.push_back({20.0 + g[0], -7.0 + 2.0 * g[1], normalize_angle(3.0 + 0.3 * g[2])});
    made.weights.push_back(std::exp(g[3]));
  }
  return made;
}

TEST(MomentSums, AreThoseOfThePlainLoop) {
  for (const std::size_t n : {1, 7, 8, 9, 500}) {
    const Weighted made = some_poses(n);
    const Pose2 mean{20.1, -7.2, 3.1};
    FirstSums first{};
    SecondSums second{};
    for (std::size_t i = 0; i < n; ++i) {
      const Pose2& p = made.poses[i];
      const double w = made.weights[i], dx = p.x - mean.x, dy = p.y - mean.y;
      const double dt = angle_difference(p.theta, mean.theta);
      first.weight += w, first.x += w * p.x, first.y += w * p.y;
      first.cosine += w * std::cos(p.theta), first.sine += w * std::sin(p.theta);
      second.xx += w * dx * dx, second.xy += w * dx * dy, second.xt += w * dx * dt;
      second.yy += w * dy * dy, second.yt += w * dy * dt, second.tt += w * dt * dt;
    }
    test::on_every_simd_path([&](SimdPath path) {
      const FirstSums f = first_sums(made.poses, made.weights);
      const SecondSums s = second_sums(mean, made.poses, made.weights);
      const double tolerance = 1e-12 * static_cast<double>(100 + n * 100);
      EXPECT_NEAR(f.weight, first.weight, tolerance) << name_of(path);
      EXPECT_NEAR(f.x, first.x, tolerance);
      EXPECT_NEAR(f.y, first.y, tolerance);
      EXPECT_NEAR(f.cosine, first.cosine, tolerance);
      EXPECT_NEAR(f.sine, first.sine, tolerance);
      EXPECT_NEAR(s.xx, second.xx, tolerance);
      EXPECT_NEAR(s.xy, second.xy, tolerance);
      EXPECT_NEAR(s.xt, second.xt, tolerance);
      EXPECT_NEAR(s.yy, second.yy, tolerance);
      EXPECT_NEAR(s.yt, second.yt, tolerance);
      EXPECT_NEAR(s.tt, second.tt, tolerance);
    });
  }
}

TEST(MomentSums, EveryPathGivesTheSameBits) {
  const Weighted made = some_poses(1003);
  const FirstSums first = first_sums(made.poses, made.weights);
  const SecondSums second = second_sums({20, -7, 3}, made.poses, made.weights);
  test::on_every_simd_path([&](SimdPath path) {
    const FirstSums f = first_sums(made.poses, made.weights);
    const SecondSums s = second_sums({20, -7, 3}, made.poses, made.weights);
    EXPECT_EQ(std::memcmp(&f, &first, sizeof(f)), 0) << name_of(path);
    EXPECT_EQ(std::memcmp(&s, &second, sizeof(s)), 0) << name_of(path);
  });
}

TEST(MomentSums, HeadingsOfManyTurnsCountAsTheyAre) {
  std::vector<Pose2> poses = {{1, 2, 0.5 + 1e8 * kTwoPi}, {1, 2, 0.5}};
  const PoseMoments moments = weighted_moments(poses, std::vector<double>{1.0, 1.0});
  EXPECT_NEAR(moments.mean.theta, 0.5, 1e-6);
  EXPECT_NEAR(moments.covariance(2, 2), 0.0, 1e-12);
}

}  // namespace
}  // namespace cairn
