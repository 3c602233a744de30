#include "cairn/bayes/hypotheses.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/rng.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace cairn {
namespace {

PoseHypotheses find(const std::vector<Pose2>& poses, std::vector<double> weights = {},
                    const HypothesisOptions& options = {}) {
  if (weights.empty()) weights.assign(poses.size(), 1.0);
  return find_hypotheses(poses, weights, options);
}

/// `count` poses around a mean, 0.2 m and 0.1 rad wide.
void add_cloud(std::vector<Pose2>& poses, const Pose2& mean, int count) {
  const RandomStream random(7, RandomPurpose::kTest, 0);
  for (int i = 0; i < count; ++i) {
    const auto n = random.normal4(static_cast<std::uint32_t>(poses.size()));
    poses.push_back({mean.x + 0.2 * n[0], mean.y + 0.2 * n[1], normalize_angle(mean.theta + 0.1 * n[2])});
  }
}

TEST(Hypotheses, ACloudOnTheCornerOfCellsIsOneWhereverItFaces) {
  for (int turn = 0; turn < 16; ++turn) {
    std::vector<Pose2> poses;
    add_cloud(poses, {4.0, -2.0, turn * kPi / 8.0}, 200);
    const PoseHypotheses h = find(poses);
    ASSERT_EQ(h.found.size(), 1u) << turn;
    EXPECT_NEAR(h.found[0].weight, 1.0, 0.01);
  }
}

TEST(Hypotheses, EachHasItsOwnMomentsAndTheHeaviestComesFirst) {
  std::vector<Pose2> poses;
  add_cloud(poses, {0.0, 0.0, kPi}, 400);
  add_cloud(poses, {6.0, 1.0, 0.5}, 400);
  std::vector<double> weights(800, 1.0);
  std::fill(weights.begin() + 400, weights.end(), 3.0);
  const PoseHypotheses h = find(poses, weights);
  ASSERT_EQ(h.found.size(), 2u);
  EXPECT_NEAR(h.found[0].weight, 0.75, 1e-9);
  EXPECT_NEAR(h.found[0].mean.x, 6.0, 0.05);
  EXPECT_NEAR(std::sqrt(h.found[0].covariance(0, 0)), 0.2, 0.03);  // not the 2.6 m of the whole belief
  EXPECT_NEAR(std::abs(h.found[1].mean.theta), kPi, 0.03);
  EXPECT_NEAR(std::sqrt(h.found[1].covariance(2, 2)), 0.1, 0.02);
  EXPECT_EQ(h.found[1].particles, 400u);
  EXPECT_EQ(h.label.front(), 1);
  EXPECT_EQ(h.label.back(), 0);
}

TEST(Hypotheses, FourHeadingsAtOnePlaceStayApart) {
  std::vector<Pose2> poses;
  for (int quarter = 0; quarter < 4; ++quarter) add_cloud(poses, {0.1, 0.1, quarter * kPi / 2.0}, 100);
  EXPECT_EQ(find(poses).found.size(), 4u);
}

TEST(Hypotheses, LightGroupsAreNotSignificant) {
  std::vector<Pose2> poses = {{0.0, 0.0, 0.0}, {10.0, 0.0, 0.0}, {20.0, 0.0, 0.0}};
  const PoseHypotheses h = find(poses, {1.0, 0.02, 0.005});
  ASSERT_EQ(h.found.size(), 2u);
  EXPECT_EQ(h.label, (std::vector<int>{0, 1, -1}));
  EXPECT_NEAR(h.found[0].weight, 1.0 / 1.025, 1e-9);
}

TEST(Hypotheses, AWideBeliefIsOneAsFarAsItHangsTogether) {
  std::vector<Pose2> poses;
  for (int i = 0; i < 200; ++i) poses.push_back({0.1 * i, 0.0, 0.1});
  EXPECT_EQ(find(poses).found.size(), 1u);
}

// The grid cuts a belief wider than its cells, and the means of the pieces are a cell apart.
TEST(Hypotheses, PiecesOfOneCloudAreNoHypotheses) {
  const RandomStream random(8, RandomPurpose::kTest, 0);
  std::vector<Pose2> poses;
  for (std::uint32_t i = 0; i < 4000; ++i) {
    const auto n = random.normal4(i);
    poses.push_back({2.0 * n[0], 1.5 * n[1], normalize_angle(3.0 + 0.6 * n[2])});
  }
  const PoseHypotheses h = find(poses);
  ASSERT_EQ(h.found.size(), 1u);
  EXPECT_GT(h.found[0].weight, 0.99);
  EXPECT_GT(find(poses, {}, {.fuse_sigmas = 0.0}).found.size(), 5u);
}

// Where two groups meet by a few strays, there is a valley between them.
TEST(Hypotheses, StraysBetweenGroupsDoNotJoinThem) {
  std::vector<Pose2> poses;
  add_cloud(poses, {0.1, 0.1, 0.1}, 200);
  add_cloud(poses, {0.1, 0.1, 1.0}, 200);
  add_cloud(poses, {0.1, 0.1, 0.55}, 10);
  HypothesisOptions options{.cell_rad = 0.2, .fuse_rad = 0.5};
  EXPECT_EQ(find(poses, {}, options).found.size(), 2u);
  options.valley = 0.0;
  EXPECT_EQ(find(poses, {}, options).found.size(), 1u);
}

TEST(Hypotheses, WeightlessPosesBelongToNone) {
  const PoseHypotheses h = find({{0.0, 0.0, 0.0}, {50.0, 0.0, 0.0}}, {1.0, 0.0});
  EXPECT_EQ(h.label, (std::vector<int>{0, -1}));
}

}  // namespace
}  // namespace cairn
