#include "cairn/localization/hypothesis_track.hpp"

#include "cairn/core/angle.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

PoseHypothesis place(const Pose2& mean, double weight) {
  PoseHypothesis p;
  p.mean = mean;
  p.weight = weight;
  p.covariance(0, 0) = 0.01;
  return p;
}

class Follower {
 public:
  const std::vector<Hypothesis>& operator()(const std::vector<PoseHypothesis>& found, const Pose2& moved = {},
                                            double since_s = 1.0) {
    follow_hypotheses(found, moved, since_s, {}, known_, scratch_);
    return known_.places;
  }

 private:
  HypothesisTrack known_;
  std::vector<Hypothesis> scratch_;
};

TEST(HypothesisTrack, WhatContinuesGrowsOlderAlongTheMotion) {
  Follower follow;
  EXPECT_EQ(follow({place({0, 0, 0}, 1.0)}).front().age_s, 0.0);
  // Five metres ahead: the same place only because the robot drove there.
  EXPECT_EQ(follow({place({5.1, 0, 0}, 1.0)}, {5, 0, 0}, 2.0).front().age_s, 2.0);
  EXPECT_EQ(follow({place({9, 0, 0}, 1.0)}).front().age_s, 0.0);
}

TEST(HypothesisTrack, TheOrderOfTheWeightsMayChange) {
  Follower follow;
  follow({place({0, 0, 0}, 0.6), place({8, 0, 0}, 0.4)});
  follow({place({0, 0, 0}, 0.6), place({8, 0, 0}, 0.3), place({3, 3, 0}, 0.1)});
  const auto& now = follow({place({3, 3, 0}, 0.5), place({8, 0, 0}, 0.5)});
  EXPECT_EQ(now[0].age_s, 1.0);
  EXPECT_EQ(now[1].age_s, 2.0);
  EXPECT_EQ(now[0].id, 3u);
  EXPECT_EQ(now[1].id, 2u);
  EXPECT_EQ(now[1].weight, 0.5);
  EXPECT_EQ(now[1].covariance(0, 0), 0.01);
}

TEST(HypothesisTrack, TwoCannotContinueOne) {
  Follower follow;
  follow({place({0, 0, 0}, 1.0)});
  const auto& now = follow({place({0.2, 0, 0}, 0.6), place({-1.2, 0, 0}, 0.4)});
  EXPECT_EQ(now[0].age_s, 1.0);
  EXPECT_EQ(now[1].age_s, 0.0);
}

TEST(HypothesisTrack, HeadingsWrapAround) {
  Follower follow;
  follow({place({0, 0, kPi - 0.1}, 1.0)});
  EXPECT_EQ(follow({place({0, 0, -kPi + 0.1}, 1.0)}).front().age_s, 1.0);
  EXPECT_EQ(follow({place({0, 0, 0}, 1.0)}).front().age_s, 0.0);
}

}  // namespace
}  // namespace cairn
