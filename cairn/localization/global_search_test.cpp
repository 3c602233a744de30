#include "cairn/localization/global_search.hpp"

#include "fake_fusion.hpp"
#include "listening_filter.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr Pose2 kHere{7.0, 3.0, 1.0};
constexpr Pose2 kThere{-2.0, 5.0, 0.0};

/// Finds what it is told to find.
class Told final : public StreamModel {
 public:
  BoundUpdate<Pose2> bind(const Event::Payload&, bool) const override { return {}; }
  double explained_share(const Event::Payload&, const Pose2&) const override { return 1.0; }
  double beams(const Event::Payload&) const override { return 1.0; }
  bool informs(const Event::Payload&) const override { return true; }
  std::vector<LocatedPose> locate(std::span<const Glimpse> way, std::span<const Pose2> asked) const override {
    seen.assign(way.begin(), way.end());
    asked_for.assign(asked.begin(), asked.end());
    ++searches;
    return found;
  }

  std::vector<LocatedPose> found = {{.T_map_base = kHere, .weight = 1.0}};
  mutable std::vector<Glimpse> seen;
  mutable std::vector<Pose2> asked_for;
  mutable int searches = 0;
};

class GlobalSearchTest : public testing::Test {
 protected:
  // Drives straight on; returns how often it was searched.
  int drive(int looks, double step_m = 0.6) {
    int changed = 0;
    for (int i = 0; i < looks; ++i) {
      GlobalSearch::carry(memory_, {.T_before_after = {step_m, 0.0, 0.0}});
      changed += search_.observe(memory_, 0, model_, {}, places_, filter_) ? 1 : 0;
    }
    return changed;
  }

  GlobalOptions options_;
  GlobalSearch search_{options_};
  GlobalSearchMemory memory_;
  Told model_;
  test::ListeningFilter filter_;
  std::vector<Hypothesis> places_{1, Hypothesis{.T_map_base = kHere, .weight = 1.0}};
};

TEST_F(GlobalSearchTest, SearchesAgainAfterEveryFewLooksAndLeavesTheParticlesAlone) {
  places_[0].T_map_base = kThere;
  search_.begin(memory_, 0, model_, {});
  EXPECT_EQ(drive(options_.search_every - 1), 0);
  EXPECT_EQ(drive(1), 1);
  EXPECT_EQ(model_.seen.size(), static_cast<std::size_t>(options_.search_every) + 1);
  EXPECT_NEAR(model_.seen.front().T_now_then.x, -0.6 * options_.search_every, 1e-12);
  ASSERT_EQ(model_.asked_for.size(), 2U) << "of the belief, and of the search before";
  EXPECT_EQ(model_.asked_for[0].x, kThere.x);
  EXPECT_TRUE(filter_.states_.empty());
}

TEST_F(GlobalSearchTest, EndsWhenSearchAndBeliefAgreeAfterEnoughLooks) {
  search_.begin(memory_, 0, model_, {});
  drive(5);
  EXPECT_TRUE(memory_.searching) << "too soon";
  drive(20);
  EXPECT_FALSE(memory_.searching);
  const int searches = model_.searches;
  drive(20);
  EXPECT_EQ(model_.searches, searches);
}

TEST_F(GlobalSearchTest, GoesOnWhileTheBeliefIsElsewhereOrWideOrThereAreOtherPlaces) {
  search_.begin(memory_, 0, model_, {});
  places_[0].T_map_base = kThere;
  drive(20);
  EXPECT_TRUE(memory_.searching);
  places_[0].T_map_base = kHere;
  filter_.compact_ = false;
  drive(20);
  EXPECT_TRUE(memory_.searching);
  filter_.compact_ = true;
  model_.found = {{.T_map_base = kHere, .weight = 0.9}, {.T_map_base = kThere, .weight = 0.1}};
  drive(20);
  EXPECT_TRUE(memory_.searching);
}

// Along a wall no look tells a place from the one a metre on.
TEST_F(GlobalSearchTest, NeighboursOfThePlaceSpeakForIt) {
  model_.found = {{.T_map_base = kHere, .weight = 0.6},
                  {.T_map_base = kHere * Pose2{1.5, 0.0, 0.0}, .weight = 0.4}};
  search_.begin(memory_, 0, model_, {});
  drive(20);
  EXPECT_FALSE(memory_.searching);
}

TEST_F(GlobalSearchTest, AWayWithoutOdometryEndsIt) {
  filter_.compact_ = false;
  search_.begin(memory_, 0, model_, {});
  drive(5);
  GlobalSearch::carry(memory_, {.T_before_after = {}, .unknown_s = 0.6});
  EXPECT_TRUE(memory_.searching) << "as at the end of a log";
  GlobalSearch::carry(memory_, {.T_before_after = {}, .unknown_s = 0.6});
  EXPECT_FALSE(memory_.searching);
  EXPECT_EQ(drive(20), 0);
}

TEST_F(GlobalSearchTest, GoesOnWithAnotherStreamWhereItsOwnFallsSilent) {
  const auto see = [&](int times, StreamId stream) {
    for (int i = 0; i < times; ++i) {
      GlobalSearch::carry(memory_, {.T_before_after = {0.6, 0.0, 0.0}});
      search_.observe(memory_, stream, model_, {}, places_, filter_);
    }
  };
  search_.begin(memory_, 0, model_, {});
  see(40, 1);
  EXPECT_EQ(model_.searches, 1) << "it may be a pause";
  see(1, 0);
  see(40, 1);
  EXPECT_EQ(model_.searches, 1);
  see(40, 1);
  EXPECT_GT(model_.searches, 1);
  EXPECT_FALSE(memory_.searching) << "confirmed by the other one";
}

TEST_F(GlobalSearchTest, StandingStillGivesNoNewLooks) {
  search_.begin(memory_, 0, model_, {});
  EXPECT_EQ(drive(100, 0.0), 0);
  EXPECT_LE(memory_.glimpses.size(), 2U);
}

TEST_F(GlobalSearchTest, ForgetsTheOldest) {
  filter_.compact_ = false;
  search_.begin(memory_, 0, model_, {});
  drive(2 * options_.search_looks);
  EXPECT_EQ(memory_.glimpses.size(), static_cast<std::size_t>(options_.search_looks));
}

TEST_F(GlobalSearchTest, WhatTheSearchHoldsPossibleStaysAPlaceOfTheBelief) {
  const std::vector<PoseHypothesis> particles{{1.0, kThere, Eigen::Matrix3d::Identity(), 100}};
  ASSERT_EQ(GlobalSearch::with_found(memory_, particles).size(), 1U);
  EXPECT_EQ(GlobalSearch::with_found(memory_, particles)[0].weight, 1.0) << "nothing is searched";
  model_.found = {{.T_map_base = kHere, .weight = 0.8}, {.T_map_base = kThere, .weight = 0.2}};
  search_.begin(memory_, 0, model_, {});
  const auto both = GlobalSearch::with_found(memory_, particles);
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].mean.x, kThere.x);
  EXPECT_DOUBLE_EQ(both[0].weight, 0.6);
  EXPECT_EQ(both[1].mean.x, kHere.x);
  EXPECT_DOUBLE_EQ(both[1].weight, 0.4);
}

TEST_F(GlobalSearchTest, ClaimsLittleBeforeItIsConfirmed) {
  Judgement judgement{.state = TrackingState::kTracking, .probability = 0.999};
  GlobalSearch::temper(memory_, judgement);
  EXPECT_EQ(judgement.probability, 0.999) << "nothing is searched";
  search_.begin(memory_, 0, model_, {});
  GlobalSearch::temper(memory_, judgement);
  EXPECT_LE(judgement.probability, GlobalSearch::kMostUnconfirmed);
  EXPECT_EQ(judgement.state, TrackingState::kAmbiguous);
  judgement = {.state = TrackingState::kLost, .probability = 0.1};
  GlobalSearch::temper(memory_, judgement);
  EXPECT_EQ(judgement.state, TrackingState::kLost);
  EXPECT_EQ(judgement.probability, 0.1);
}

TEST_F(GlobalSearchTest, WithoutASensorToSearchWithNothingIsSearched) {
  model_.found.clear();
  EXPECT_TRUE(search_.begin(memory_, 0, model_, {}).empty());
  EXPECT_FALSE(memory_.searching);
  EXPECT_EQ(drive(50), 0);
}

}  // namespace
}  // namespace cairn
