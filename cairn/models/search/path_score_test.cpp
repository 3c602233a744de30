#include "cairn/models/search/path_score.hpp"

#include "cairn/core/angle.hpp"
#include "mini_maps.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

PathLook look_from(const OccupancyGrid& map, const Pose2& truth, const Pose2& T_now_then) {
  return {select_end_points(test::scan_of(map, truth, 60), Pose2{}, {}, 0), T_now_then};
}

class ScorePath : public testing::Test {
 protected:
  // Seven looks on a way of 1.2 m; the odometry errs by 1 cm and 0.01 rad a look.
  ScorePath() {
    std::vector<Pose2> odometry{{}};
    for (int i = 0; i < 7; ++i) {
      const Pose2 step{0.2, 0.0, 0.1};
      truth_.push_back(i == 0 ? Pose2{1.5, 2.0, 0.3} : truth_.back() * step);
      if (i > 0) odometry.push_back(odometry.back() * Pose2{0.21, 0.0, 0.11});
    }
    for (std::size_t i = 0; i < truth_.size(); ++i)
      path_.push_back(look_from(map_, truth_[i], between(odometry.back(), odometry[i])));
  }

  OccupancyGrid map_ = test::mini_room();
  PoseSearch search_{map_, {}};
  std::vector<Pose2> truth_;
  std::vector<PathLook> path_;
};

TEST_F(ScorePath, FollowsTheTruthInSpiteOfDrift) {
  const PathScore score = score_path(search_, path_, truth_.back());
  ASSERT_EQ(score.T_map_then.size(), truth_.size());
  for (std::size_t i = 0; i < truth_.size(); ++i) {
    EXPECT_LT(distance(score.T_map_then[i], truth_[i]), 0.06) << i;
    EXPECT_LT(std::abs(normalize_angle(score.T_map_then[i].theta - truth_[i].theta)), 0.06) << i;
  }
  EXPECT_LT(distance(score.T_map_now, truth_.back()), 0.06);
}

TEST_F(ScorePath, TheTrueEndScoresBestByFar) {
  const double truth = score_path(search_, path_, truth_.back()).log_likelihood;
  for (const Pose2& off : {Pose2{1.0, 0.0, 0.0}, Pose2{0.0, -1.0, 0.0}, Pose2{0.0, 0.0, kPi / 2.0}})
    EXPECT_LT(score_path(search_, path_, truth_.back() * off).log_likelihood, truth - 1.0);
}

TEST_F(ScorePath, WithoutDriftAFitNeverLosesAgainstTheOdometry) {
  double straight = 0.0;
  for (const PathLook& look : path_)
    straight += search_.log_likelihood(look.points, truth_.back() * look.T_now_then) /
                static_cast<double>(look.points.size());
  EXPECT_GT(score_path(search_, path_, truth_.back()).log_likelihood, straight);
}

TEST_F(ScorePath, LooksWithoutPointsSayNothing) {
  std::vector<PathLook> path = path_;
  path.insert(path.begin(), PathLook{{}, path.front().T_now_then});
  EXPECT_DOUBLE_EQ(score_path(search_, path, truth_.back()).log_likelihood,
                   score_path(search_, path_, truth_.back()).log_likelihood);
  EXPECT_EQ(score_path(search_, {}, truth_.back()).log_likelihood, 0.0);
}

}  // namespace
}  // namespace cairn
