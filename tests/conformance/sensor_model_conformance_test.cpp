#include "cairn/core/angle.hpp"
#include "cairn/core/executor.hpp"
#include "laser_models.hpp"
#include "mini_maps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace cairn::test {
namespace {

const Pose2 kTBaseSensor{0.15, -0.05, 0.3};
// Off the borders of the cells, so that rounding does not decide in which cell a point lies.
const Pose2 kTMapGrid{0.313, -0.217, 0.1};
const std::vector<Pose2> kTruths = {{2.0, 1.2, 0.4}, {6.2, 1.5, 3.1}, {4.2, 4.2, -1.5}, {0.7, 3.7, -3.1}};

class LaserModelLaws : public ::testing::TestWithParam<LaserModelCase> {
 protected:
  const OccupancyGrid room_ = mini_room(kTMapGrid);
  const std::shared_ptr<const LaserModel> model_ = GetParam().make(room_, kTBaseSensor);

  LaserScan scan_at(const Pose2& T_map_base) const { return scan_of(room_, T_map_base * kTBaseSensor, 180); }
};

double score(const LaserModel& model, const LaserScan& scan, const Pose2& pose) {
  double out = std::nan("");
  model.log_likelihood(scan, std::span(&pose, 1), std::span(&out, 1));
  return out;
}

std::vector<Pose2> poses_anywhere(std::size_t n) {
  const RandomStream random(3, RandomPurpose::kTest, 0);
  std::vector<Pose2> poses;
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto u = random.uniform4(i);
    poses.push_back({12.0 * u[0] - 2.0, 9.0 * u[1] - 2.0, normalize_angle(kTwoPi * u[2])});
  }
  return poses;
}

TEST_P(LaserModelLaws, FiniteEverywhere) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double nan = std::nan("");
  const LaserScan scan = scan_at(kTruths[0]);
  auto poses = poses_anywhere(200);
  for (const double far : {1e4, -1e9, 1e12, -1e300, kInfinity, nan}) {
    poses.push_back({far, 1, 1});
    poses.push_back({1, far, 1});
    poses.push_back({1, 1, far});
    poses.push_back({far, far, far});
  }
  for (const Pose2& pose : poses) {
    EXPECT_TRUE(std::isfinite(score(*model_, scan, pose))) << pose.x << ' ' << pose.y << ' ' << pose.theta;
  }
}

TEST_P(LaserModelLaws, ABatchIsOneByOneAndEachScoreIsWritten) {
  const LaserScan scan = scan_at(kTruths[0]);
  const auto poses = poses_anywhere(300);
  std::vector<double> batch(poses.size(), std::nan(""));
  model_->log_likelihood(scan, poses, batch);
  for (std::size_t i = 0; i < poses.size(); ++i) EXPECT_EQ(batch[i], score(*model_, scan, poses[i]));
  model_->log_likelihood(scan, {}, {});
}

TEST_P(LaserModelLaws, TheSameBitsFromSeveralThreads) {
  const auto poses = poses_anywhere(1000);
  const BoundUpdate<Pose2> update = model_->bind(scan_at(kTruths[0]));
  const auto scores = [&](int threads, std::size_t chunk) {
    std::vector<double> out(poses.size());
    Executor(threads).for_each_chunk(poses.size(), chunk, [&](std::size_t begin, std::size_t end) {
      update.log_likelihood(std::span(poses).subspan(begin, end - begin),
                            std::span(out).subspan(begin, end - begin));
    });
    return out;
  };
  const auto expected = scores(1, poses.size());
  EXPECT_EQ(scores(1, 7), expected);
  EXPECT_EQ(scores(2, 7), expected);
  EXPECT_EQ(scores(7, 13), expected);
}

TEST_P(LaserModelLaws, InvariantWhenMapPoseAndSensorMoveTogether) {
  const Pose2 T_new_map{-40.0, 7.0, 2.2}, T_new_base{0.2, 0.1, -0.7};
  const auto moved = GetParam().make(mini_room(T_new_map * kTMapGrid), T_new_base * kTBaseSensor);
  const LaserScan scan = scan_at(kTruths[1]);
  for (const Pose2& pose : poses_anywhere(200)) {
    EXPECT_NEAR(score(*moved, scan, T_new_map * pose * inverse(T_new_base)), score(*model_, scan, pose),
                1e-6);
  }
}

TEST_P(LaserModelLaws, TheTruthScoresAbovePerturbedPoses) {
  const Pose2 steps[] = {{0.2, 0, 0},   {0, 0.2, 0},     {0, 0, 0.15},
                         {1.0, 0.5, 0}, {0, 0, kPi / 2}, {0.5, -0.5, 2}};
  for (const Pose2& truth : kTruths) {
    const LaserScan scan = scan_at(truth);
    const double best = score(*model_, scan, truth);
    for (const Pose2& step : steps) {
      EXPECT_GT(best, score(*model_, scan, truth * step) + GetParam().margin_nat);
      EXPECT_GT(best, score(*model_, scan, truth * inverse(step)) + GetParam().margin_nat);
    }
  }
}

TEST_P(LaserModelLaws, AScanThatSaysNothingChangesNothing) {
  LaserScan none = scan_at(kTruths[0]);
  LaserScan empty = none, not_numbers = none, negative = none;
  std::fill(none.ranges_m.begin(), none.ranges_m.end(), 0.0f);
  std::fill(not_numbers.ranges_m.begin(), not_numbers.ranges_m.end(), std::nanf(""));
  std::fill(negative.ranges_m.begin(), negative.ranges_m.end(), -2.0f);
  empty.ranges_m.clear();
  for (const LaserScan& scan : {none, not_numbers, negative, empty}) {
    const double here = score(*model_, scan, kTruths[0]);
    EXPECT_TRUE(std::isfinite(here));
    for (const Pose2& pose : poses_anywhere(50)) EXPECT_EQ(score(*model_, scan, pose), here);
  }
}

TEST_P(LaserModelLaws, AnglesThatDoNotAdvanceOrAreNotFiniteGiveFiniteScores) {
  for (const auto& [first, increment] :
       {std::pair{0.0, 0.0}, {0.0, 1e300}, {std::nan(""), 0.1}, {0.0, std::nan("")}}) {
    LaserScan scan = scan_at(kTruths[0]);
    scan.angle_min_rad = first;
    scan.angle_increment_rad = increment;
    EXPECT_TRUE(std::isfinite(score(*model_, scan, kTruths[0]))) << first << ' ' << increment;
    EXPECT_TRUE(std::isfinite(model_->explained_share(scan, kTruths[0])));
  }
}

TEST_P(LaserModelLaws, TheGradientAgreesWithNumericDifferences) {
  constexpr double kStep = 1e-6;
  const BoundUpdate<Pose2> update = model_->bind(scan_at(kTruths[0]));
  if (!update.gradient || !GetParam().gradient_is_exact) GTEST_SKIP() << "the model has no exact gradient";
  const RandomStream random(4, RandomPurpose::kTest, 0);
  for (std::uint32_t i = 0; i < 50; ++i) {
    const auto n = random.normal4(i);
    const Pose2 pose = kTruths[0] * Pose2{0.05 * n[0], 0.05 * n[1], 0.03 * n[2]};
    Eigen::Vector3d gradient;
    update.gradient(std::span(&pose, 1), std::span(&gradient, 1));
    const Pose2 steps[] = {{kStep, 0, 0}, {0, kStep, 0}, {0, 0, kStep}};
    for (int k = 0; k < 3; ++k) {
      const Pose2 d = steps[k];
      const Pose2 both[] = {{pose.x - d.x, pose.y - d.y, pose.theta - d.theta},
                            {pose.x + d.x, pose.y + d.y, pose.theta + d.theta}};
      double scores[2];
      update.log_likelihood(both, scores);
      EXPECT_NEAR(gradient[k], (scores[1] - scores[0]) / (2.0 * kStep), 1e-3)
          << "pose " << i << ", component " << k;
    }
  }
  const Pose2 nowhere{std::nan(""), 0, 0};
  Eigen::Vector3d none;
  update.gradient(std::span(&nowhere, 1), std::span(&none, 1));
  EXPECT_TRUE(none.allFinite());
}

TEST_P(LaserModelLaws, TheUpdateKeepsTheStampAndWhatItNeeds) {
  LaserScan scan = scan_at(kTruths[0]);
  scan.stamp = Time(Duration(42));
  const double expected = score(*model_, scan, kTruths[0]);
  BoundUpdate<Pose2> update = GetParam().make(room_, kTBaseSensor)->bind(scan);  // outlives that model
  std::fill(scan.ranges_m.begin(), scan.ranges_m.end(), 1.0f);
  double after = std::nan("");
  update.log_likelihood(std::span(kTruths).first(1), std::span(&after, 1));
  EXPECT_EQ(after, expected);
  EXPECT_EQ(update.stamp, scan.stamp);
}

INSTANTIATE_TEST_SUITE_P(Conformance, LaserModelLaws, ::testing::ValuesIn(laser_models()),
                         [](const auto& chosen) { return chosen.param.name; });

}  // namespace
}  // namespace cairn::test
