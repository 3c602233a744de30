#include "cairn/bayes/resampling/two_stage.hpp"

#include "cairn/bayes/pose_kernel.hpp"
#include "cairn/bayes/resampling/cumulative_weights.hpp"
#include "cairn/bayes/resampling/systematic.hpp"
#include "cairn/core/angle.hpp"
#include "cairn/core/statistics.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

const RandomStream kRandom(3, RandomPurpose::kTest, 0);

std::vector<double> cumulative_of(const std::vector<double>& weights) {
  std::vector<double> logs;
  for (const double w : weights) logs.push_back(std::log(w));
  normalize_log_weights(logs);
  return cumulative_weights(logs);
}

std::vector<std::uint32_t> draw(const std::shared_ptr<ClusterTable>& table,
                                const std::vector<double>& weights, std::size_t count) {
  std::vector<std::uint32_t> ancestors;
  TwoStage(table).draw(cumulative_of(weights), count, {kRandom, 0}, ancestors);
  return ancestors;
}

TEST(TwoStage, EveryClusterIsDrawnWhateverItsWeight) {
  const auto table = std::make_shared<ClusterTable>(ClusterTable{{0, 0, 1, 1, -1}, 2, 5});
  const auto drawn = draw(table, {50.0, 50.0, 0.1, 0.3, 5.0}, 40);
  ASSERT_EQ(drawn.size(), 40u);
  const auto times = [&](std::uint32_t i) { return std::count(drawn.begin(), drawn.end(), i); };
  EXPECT_EQ(times(0), 10);
  EXPECT_EQ(times(1), 10);
  EXPECT_EQ(times(2), 5);  // within its cluster by weight: 0.1 to 0.3
  EXPECT_EQ(times(3), 15);
  EXPECT_EQ(times(4), 0);  // of no significant cluster
}

TEST(TwoStage, OneClusterIsSystematicResampling) {
  const std::vector<double> weights = {0.5, 2.0, 0.1, 1.0, 3.0, 0.7};
  const auto table = std::make_shared<ClusterTable>(ClusterTable{std::vector<int>(6, 0), 1, 6});
  std::vector<std::uint32_t> expected;
  Systematic().draw(cumulative_of(weights), 25, {kRandom, 0}, expected);
  EXPECT_EQ(draw(table, weights, 25), expected);
  table->label.clear();
  EXPECT_EQ(draw(table, weights, 25), expected);
}

TEST(TwoStage, SharesDifferByAtMostOne) {
  const auto table = std::make_shared<ClusterTable>(ClusterTable{{0, 1, 2}, 3, 3});
  for (const std::size_t count : {3u, 10u, 11u, 500u}) {
    const auto drawn = draw(table, {1.0, 1.0, 1.0}, count);
    ASSERT_EQ(drawn.size(), count);
    for (std::uint32_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(static_cast<double>(std::count(drawn.begin(), drawn.end(), i)),
                  static_cast<double>(count) / 3.0, 1.0);
    }
  }
}

TEST(ClusterWatch, SeveralClustersAreNotCompact) {
  const auto table = std::make_shared<ClusterTable>();
  ClusterWatch watch(table, {}, std::make_unique<PoseKernel>(PoseKernelOptions{}));
  ParticleSet<Pose2> particles{{{0.0, 0.0, 0.0}, {10.0, 0.0, 0.0}}, {std::log(0.93), std::log(0.07)}};
  EXPECT_FALSE(watch.fit(particles));
  EXPECT_EQ(table->clusters, 2u);
  EXPECT_EQ(table->label, (std::vector<int>{0, 1}));
  particles.log_weights = {std::log(0.999), std::log(0.001)};
  EXPECT_TRUE(watch.fit(particles));
  EXPECT_EQ(table->clusters, 1u);
  particles.states[1] = {0.1, 0.0, 1.6};
  particles.log_weights = {std::log(0.7), std::log(0.3)};
  EXPECT_TRUE(watch.fit(particles));  // on the way of one belief to a narrow one
  EXPECT_EQ(table->clusters, 1u);
}

// What tracks one pose is not split by stragglers (a wide turn by bad odometry): they neither get a share of
// their own nor are they given up.
TEST(ClusterWatch, StragglersOfACompactBeliefAreNoHypothesis) {
  const auto table = std::make_shared<ClusterTable>();
  ClusterWatch watch(table, {}, std::make_unique<PoseKernel>(PoseKernelOptions{}));
  EXPECT_TRUE(watch.fit({{{0.0, 0.0, 0.0}, {0.1, 0.0, 0.9}}, {std::log(0.97), std::log(0.03)}}));
  EXPECT_EQ(table->clusters, 1u);
  EXPECT_TRUE(table->label.empty());  // not one of the particles is given up
  EXPECT_EQ(table->particles, 2u);
}

// Poses that cross at one place are as near to each other as those of a compact belief, but for their
// headings.
TEST(ClusterWatch, HeadingsThatCrossAtOnePlaceAreHypotheses) {
  const auto table = std::make_shared<ClusterTable>();
  ClusterWatch watch(table, {}, std::make_unique<PoseKernel>(PoseKernelOptions{}));
  for (const int count : {2, 4}) {
    ParticleSet<Pose2> particles;
    for (int i = 0; i < count; ++i) {
      particles.states.push_back({0.1 * i, 0.0, normalize_angle(i * kTwoPi / count)});
      particles.log_weights.push_back(-std::log(count));
    }
    table->clusters = static_cast<std::size_t>(count);  // before they met
    EXPECT_FALSE(watch.fit(particles));
    EXPECT_EQ(table->clusters, static_cast<std::size_t>(count));
  }
}

TEST(ClusterWatch, ItsMemoryComesBack) {
  const auto table = std::make_shared<ClusterTable>();
  ClusterWatch watch(table, {}, std::make_unique<PoseKernel>(PoseKernelOptions{}));
  watch.fit({{{0.0, 0.0, 0.0}, {10.0, 0.0, 0.0}}, {std::log(0.6), std::log(0.4)}});
  PartMemory memory;
  watch.save(memory);
  *table = {};
  PartMemory::Reader reader(memory);
  watch.load(reader);
  EXPECT_EQ(table->clusters, 2u);
  EXPECT_EQ(table->particles, 2u);
  EXPECT_EQ(table->label, (std::vector<int>{0, 1}));
}

TEST(NeverFewerWhileClustered, KeepsTheNumberWhileThereAreSeveral) {
  const auto table = std::make_shared<ClusterTable>(ClusterTable{{}, 2, 900});
  NeverFewerWhileClustered size(table, std::make_unique<FixedSize<Pose2>>(1000));
  EXPECT_EQ(size.begin(), 1000u);
  NeverFewerWhileClustered small(table, std::make_unique<KldSize>(KldOptions{}, 100, 5000));
  EXPECT_EQ(small.begin(), 900u);
  table->clusters = 1;
  EXPECT_EQ(small.begin(), 100u);
}

}  // namespace
}  // namespace cairn
