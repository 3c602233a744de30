#include "cairn/bayes/occupied_bins.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/rng.hpp"

#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace cairn {
namespace {

std::size_t one_by_one(std::span<const Pose2> poses) {
  const PoseBins bins{KldOptions{}};
  std::set<std::uint64_t> keys;
  for (const Pose2& pose : poses) keys.insert(bins.key(pose));
  return keys.size();
}

std::vector<Pose2> poses_around(const Pose2& center, double spread_m, std::uint32_t seed) {
  const RandomStream random(seed, RandomPurpose::kTest, 0);
  std::vector<Pose2> poses;
  for (std::uint32_t i = 0; i < 2000; ++i) {
    const auto n = random.normal4(i);
    poses.push_back({center.x + spread_m * n[0], center.y + spread_m * n[1],
                     normalize_angle(center.theta + spread_m * n[2])});
  }
  return poses;
}

TEST(OccupiedBins, AreThoseOfTheKeys) {
  OccupiedBins bins{KldOptions{}};
  for (const double spread : {0.01, 0.3, 2.0, 6.0, 50.0}) {
    for (const Pose2& center : {Pose2{0, 0, 0}, Pose2{-3e4, 7.3, 3.1}, Pose2{1.0, 1e5, -1.0}}) {
      const auto poses = poses_around(center, spread, 1);
      bins.clear();
      bins.insert(poses);
      EXPECT_EQ(bins.size(), one_by_one(poses)) << spread << ' ' << center.x;
    }
  }
}

TEST(OccupiedBins, GrowFromBatchToBatchAndBeginAnew) {
  OccupiedBins bins{KldOptions{}};
  const auto poses = poses_around({5, 5, 1}, 3.0, 2);
  for (int round = 0; round < 600; ++round) {  // more rounds than a mark can tell apart
    bins.clear();
    EXPECT_EQ(bins.size(), 0u);
    bins.insert(std::span(poses).subspan(static_cast<std::size_t>(round), 1));
    ASSERT_EQ(bins.size(), 1u) << round;
  }
  bins.clear();
  for (std::size_t begin = 0; begin < poses.size(); begin += 100)
    bins.insert(std::span(poses).subspan(begin, 100));
  EXPECT_EQ(bins.size(), one_by_one(poses));
}

TEST(OccupiedBins, HeadingsThatDifferByFullTurnsShareABin) {
  OccupiedBins bins{KldOptions{}};
  bins.clear();
  bins.insert(std::vector<Pose2>{{1, 1, 2.0}, {1, 1, 2.0 + kTwoPi}, {1, 1, 2.0 - 3.0 * kTwoPi}});
  EXPECT_EQ(bins.size(), 1u);
}

}  // namespace
}  // namespace cairn
