#include "cairn/bayes/pose_kernel.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/statistics.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// Sample of a Gaussian around `mean`; a share of `stragglers` lies 50 m away.
ParticleSet<Pose2> sample(std::size_t n, const Pose2& mean, const Pose2& sigma, double stragglers = 0.0) {
  const RandomStream random(1, RandomPurpose::kTest, 0);
  ParticleSet<Pose2> particles;
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto x = random.normal4(i);
    const double away = i < stragglers * static_cast<double>(n) ? 50.0 : 0.0;
    particles.states.push_back({mean.x + sigma.x * x[0] + away, mean.y + sigma.y * x[1],
                                normalize_angle(mean.theta + sigma.theta * x[2])});
  }
  particles.log_weights.assign(n, -std::log(static_cast<double>(n)));
  return particles;
}

// Standard deviations of the moves that a kernel makes.
Pose2 spread_of_moves(const PoseKernel& kernel) {
  std::vector<Pose2> moved(100'000, Pose2{1, 2, 3.1});
  kernel.move(moved, {1, RandomPurpose::kTest, 1}, 3);
  const auto m = weighted_moments(moved, std::vector<double>(moved.size(), 1.0));
  EXPECT_NEAR(m.mean.x, 1.0, 0.01);  // no drift: moves of 0.1 m and less, 100 000 of them
  EXPECT_NEAR(m.mean.y, 2.0, 0.01);
  EXPECT_NEAR(angle_difference(m.mean.theta, 3.1), 0.0, 0.01);
  EXPECT_NEAR(m.covariance(0, 1), 0.0, 1e-3);
  return {std::sqrt(m.covariance(0, 0)), std::sqrt(m.covariance(1, 1)), std::sqrt(m.covariance(2, 2))};
}

TEST(PoseKernel, MovesByAShareOfTheParticlesOwnSpread) {
  PoseKernel kernel({});
  EXPECT_TRUE(kernel.fit(sample(10'000, {5, 5, kPi}, {0.2, 0.1, 0.05})));  // facing west
  // Relative standard error of a standard deviation of n numbers: 1/sqrt(2 n); 4.9 of them for 1e-6 each,
  // 10 000 particles and 100 000 moves: 3.5 % and 1.1 %.
  const Pose2 moves = spread_of_moves(kernel);
  EXPECT_NEAR(moves.x, 0.4 * 0.2, 0.05 * 0.08);
  EXPECT_NEAR(moves.y, 0.4 * 0.1, 0.05 * 0.04);
  EXPECT_NEAR(moves.theta, 0.4 * 0.05, 0.05 * 0.02);
}

TEST(PoseKernel, AWideBeliefIsNotCompactAndGetsTheWideMoves) {
  PoseKernel kernel({});
  EXPECT_FALSE(kernel.fit(sample(10'000, {0, 0, 0}, {5.0, 5.0, 1.0})));
  const Pose2 moves = spread_of_moves(kernel);
  EXPECT_NEAR(moves.x, 0.1, 0.0011);
  EXPECT_NEAR(moves.y, 0.1, 0.0011);
  EXPECT_NEAR(moves.theta, 0.05, 0.00055);
}

TEST(PoseKernel, AFewStragglersDoNotMatter) {
  PoseKernel kernel({});
  EXPECT_TRUE(kernel.fit(sample(10'000, {5, 5, 1}, {0.2, 0.1, 0.05}, 0.03)));
  EXPECT_NEAR(spread_of_moves(kernel).x, 0.4 * 0.2, 0.05 * 0.08);  // of the group, not of the stragglers
}

TEST(PoseKernel, TwoPlacesAreNotOneGroup) {
  PoseKernel kernel({});
  EXPECT_FALSE(kernel.fit(sample(10'000, {5, 5, 1}, {0.2, 0.1, 0.05}, 0.1)));
  EXPECT_FALSE(kernel.fit(sample(10'000, {5, 5, 1}, {0.2, 0.1, 0.05}, 0.5)));
}

TEST(PoseKernel, WeightsDecideNotNumbers) {
  ParticleSet<Pose2> particles = sample(10'000, {5, 5, 1}, {0.2, 0.1, 0.05}, 0.5);
  for (std::size_t i = 0; i < 5'000; ++i) particles.log_weights[i] -= 20.0;
  normalize_log_weights(particles.log_weights);
  EXPECT_TRUE(PoseKernel({}).fit(particles));
}

TEST(PoseKernel, TheLimitOfTheSpreadIsAnOption) {
  const auto particles = sample(10'000, {5, 5, 1}, {0.2, 0.1, 0.05});  // 0.224 m in position
  PoseKernelOptions narrow;
  narrow.largest_spread_m = 0.2;
  EXPECT_FALSE(PoseKernel(narrow).fit(particles));
  narrow.largest_spread_m = 0.25;
  EXPECT_TRUE(PoseKernel(narrow).fit(particles));
}

TEST(PoseKernel, CopiesOfOnePoseStayThere) {
  PoseKernel kernel({});
  EXPECT_TRUE(kernel.fit(sample(100, {5, 5, 1}, {0, 0, 0})));
  std::vector<Pose2> moved(10, Pose2{5, 5, 1});
  kernel.move(moved, {1, RandomPurpose::kTest, 1}, 1);
  for (const Pose2& p : moved) EXPECT_NEAR(distance(p, {5, 5, 1}), 0.0, 1e-12);
}

TEST(PoseKernel, MovesDifferPerParticleAndDraw) {
  PoseKernel kernel({});
  kernel.fit(sample(100, {0, 0, 0}, {0.1, 0.1, 0.1}));
  std::vector<Pose2> first(3), again(3), other(3);
  kernel.move(first, {1, RandomPurpose::kTest, 1}, 1);
  kernel.move(again, {1, RandomPurpose::kTest, 1}, 1);
  kernel.move(other, {1, RandomPurpose::kTest, 1}, 2);
  EXPECT_EQ(first, again);
  EXPECT_NE(first[0], first[1]);
  EXPECT_NE(first[0], other[0]);
}

}  // namespace
}  // namespace cairn
