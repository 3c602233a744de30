#include "cairn/bayes/clustering.hpp"

#include "cairn/core/angle.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include <gtest/gtest.h>

namespace cairn {
namespace {

Clusters cluster(const std::vector<Pose2>& poses, std::vector<double> weights = {},
                 const ClusterOptions& options = {}) {
  if (weights.empty()) weights.assign(poses.size(), 1.0);
  return cluster_poses(poses, weights, options);
}

TEST(Clustering, FacingWestIsOneCluster) {
  const auto c = cluster({{0.5, 0.5, 3.1}, {0.5, 0.5, -3.1}, {0.6, 0.5, kPi - 1e-9}, {0.6, 0.5, -kPi}});
  EXPECT_EQ(c.label, (std::vector<int>{0, 0, 0, 0}));
  ASSERT_EQ(c.weight.size(), 1u);
  EXPECT_DOUBLE_EQ(c.weight[0], 1.0);
}

TEST(Clustering, PlacesApartAreSeparateAndTheHeaviestComesFirst) {
  const auto c =
      cluster({{0.5, 0.5, 0.1}, {20.5, 0.5, 0.1}, {20.6, 0.5, 0.1}, {0.5, 30.5, 0.1}}, {2.0, 3.0, 3.0, 1.0});
  EXPECT_EQ(c.label, (std::vector<int>{1, 0, 0, 2}));
  ASSERT_EQ(c.weight.size(), 3u);
  EXPECT_DOUBLE_EQ(c.weight[0], 6.0 / 9.0);
  EXPECT_DOUBLE_EQ(c.weight[1], 2.0 / 9.0);
  EXPECT_DOUBLE_EQ(c.weight[2], 1.0 / 9.0);
}

TEST(Clustering, OppositeHeadingsAtOnePlaceAreSeparate) {
  EXPECT_EQ(cluster({{0.5, 0.5, 0.1}, {0.5, 0.5, -3.0}}).weight.size(), 2u);
}

TEST(Clustering, NeighbouringCellsBelongTogetherAlsoAcrossCorners) {
  EXPECT_EQ(cluster({{0.9, 0.9, 0.1}, {1.1, 1.1, 0.8}}).weight.size(), 1u);
  EXPECT_EQ(cluster({{-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}}).weight.size(), 1u);  // across the origin
  EXPECT_EQ(cluster({{0.9, 0.5, 0.1}, {2.1, 0.5, 0.1}}).weight.size(), 2u);     // one empty cell between
}

TEST(Clustering, AChainOfCellsHangsTogether) {
  std::vector<Pose2> chain;
  for (int i = 0; i < 50; ++i) chain.push_back({0.5 + i, 0.5, 0.1});
  EXPECT_EQ(cluster(chain).weight.size(), 1u);
  chain.erase(chain.begin() + 25);
  const auto broken = cluster(chain);
  ASSERT_EQ(broken.weight.size(), 2u);
  EXPECT_EQ(broken.label.front(), 0);  // 25 poses before the gap, 24 behind it
  EXPECT_EQ(broken.label.back(), 1);
}

TEST(Clustering, CellsOfNoWeightDoNotJoin) {
  const auto c = cluster({{0.5, 0.5, 0.1}, {1.5, 0.5, 0.1}, {2.5, 0.5, 0.1}}, {1.0, 1e-4, 1.0});
  EXPECT_EQ(c.weight.size(), 2u);  // the thin bridge does not connect
  EXPECT_EQ(c.label[1], -1);
  EXPECT_NEAR(c.weight[0] + c.weight[1], 1.0 - 0.5e-4, 1e-8);
}

TEST(Clustering, ABeliefThatIsThinEverywhereHasNoCluster) {
  std::vector<Pose2> poses;
  for (int i = 0; i < 2000; ++i) poses.push_back({10.5 * i, 0.5, 0.1});
  const auto c = cluster(poses);
  EXPECT_TRUE(c.weight.empty());
  EXPECT_TRUE(std::all_of(c.label.begin(), c.label.end(), [](int label) { return label == -1; }));
}

TEST(Clustering, NeitherScaleOfTheWeightsNorOrderOfThePosesMatters) {
  const std::vector<Pose2> poses = {{0.5, 0.5, 3.1}, {20.5, 0.5, 0.1}, {0.5, 1.5, -3.1}, {20.6, 1.5, 0.1}};
  const std::vector<Pose2> reversed(poses.rbegin(), poses.rend());
  const auto a = cluster(poses, {0.1, 0.2, 0.3, 0.1});
  auto b = cluster(reversed, {1.0, 3.0, 2.0, 1.0});
  std::reverse(b.label.begin(), b.label.end());
  EXPECT_EQ(a.label, b.label);
  EXPECT_NEAR(a.weight[0], b.weight[0], 1e-15);
}

TEST(Clustering, CoarseHeadingsFillTheCircle) {
  const ClusterOptions one_heading{.cell_m = 1.0, .cell_rad = 10.0, .min_cell_weight = 1e-3};
  EXPECT_EQ(cluster({{0.5, 0.5, 0.1}, {0.5, 0.5, -3.0}}, {}, one_heading).weight.size(), 1u);
}

TEST(Clustering, RefusesWeightsThatDoNotFit) {
  EXPECT_THROW(cluster({{0, 0, 0}}, {1.0, 1.0}), std::logic_error);
}

}  // namespace
}  // namespace cairn
