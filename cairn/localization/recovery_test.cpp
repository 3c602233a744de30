#include "cairn/localization/recovery.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "fake_fusion.hpp"
#include "listening_filter.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

using test::at;

/// Finds one place, where each scan fits better by so much than where the robot is believed.
class FoundElsewhere final : public StreamModel {
 public:
  explicit FoundElsewhere(double gain) : gain_(gain) {}
  BoundUpdate<Pose2> bind(const Event::Payload&, bool) const override { return {}; }
  double explained_share(const Event::Payload&, const Pose2&) const override { return 1.0; }
  double beams(const Event::Payload&) const override { return 1.0; }
  bool informs(const Event::Payload&) const override { return true; }
  std::optional<std::vector<LocatedPose>> search(std::span<const Glimpse> glimpses) const override {
    ++searches;
    searched_with.assign(glimpses.begin(), glimpses.end());
    return std::vector<LocatedPose>{{kPlace, 1e-4 * Eigen::Matrix3d::Identity(), 1.0, 0.0}};
  }
  bool follow(const Event::Payload&, std::span<Pose2> places, std::span<double> fits) const override {
    fits[0] = 0.0;
    for (std::size_t i = 1; i < places.size(); ++i) fits[i] = gain_ / kBeams;
    return true;
  }

  static constexpr double kBeams = 2.0;

  static constexpr Pose2 kPlace{7.0, 3.0, 1.0};
  mutable int searches = 0;
  mutable std::vector<Glimpse> searched_with;

 private:
  double gain_;
};

const std::vector<Hypothesis> kBelieved{{.T_map_base = {}, .weight = 1.0}};

class RecoveryTest : public testing::Test {
 protected:
  void observe(const StreamModel& model, double at_s, bool in_doubt) {
    recovery_.observe(memory_, 1, model, test::fake_measurement(at_s).payload, {}, in_doubt);
  }
  // One scan in doubt, a search, and whether what was found takes over at once.
  bool after_one_scan(double gain) {
    const FoundElsewhere model(gain);
    memory_ = {};
    observe(model, 1.0, true);
    recovery_.search(memory_, model, at(1.0), {});
    return recovery_.take_over(memory_, kBelieved, Standing::kDoubtful, filter_);
  }

  Recovery recovery_{RecoveryOptions{.active = true,
                                     .prior = 0.2,
                                     .rival_beams = FoundElsewhere::kBeams,
                                     .accept = 0.5,
                                     .sure = 8.0,
                                     .confirm = 0,
                                     .share = 0.6},
                     1};
  RecoveryMemory memory_;
  test::ListeningFilter filter_;
};

TEST_F(RecoveryTest, WhatIsFoundBeginsWithThePriorAndWhatTheScansFitBetter) {
  EXPECT_FALSE(after_one_scan(1.5));
  ASSERT_EQ(memory_.rivals.size(), 1u);
  EXPECT_NEAR(memory_.rivals[0].log_odds, 1.5 + std::log(0.2 / 0.8), 1e-9);
}

TEST_F(RecoveryTest, TheFilterBeginsAnewAtTheWinner) {
  EXPECT_TRUE(after_one_scan(2.9));
  const double log_odds = 2.9 + std::log(0.2 / 0.8);
  ASSERT_EQ(filter_.states_.size(), 300u);
  double x = 0.0;
  for (const Pose2& pose : filter_.states_) x += pose.x / 300.0;
  EXPECT_NEAR(x, FoundElsewhere::kPlace.x, 0.03);  // five standard deviations
  ASSERT_EQ(memory_.rivals.size(), 1u);            // where it was believed to be
  EXPECT_NEAR(memory_.rivals[0].log_odds, -log_odds, 1e-9);
}

TEST_F(RecoveryTest, AllPlacesOfADefeatedBeliefAreRivals) {
  memory_.rivals = {{{5, 0, 0}, 3.0}};
  const std::vector<Hypothesis> places{{.T_map_base = {}, .weight = 0.6},
                                       {.T_map_base = {-8, 0, 0}, .weight = 0.3}};
  ASSERT_TRUE(recovery_.take_over(memory_, places, Standing::kDoubtful, filter_));
  ASSERT_EQ(memory_.rivals.size(), 2u);
  EXPECT_NEAR(memory_.rivals[0].log_odds, -3.0, 1e-9);
  EXPECT_NEAR(memory_.rivals[1].log_odds, std::log(0.5) - 3.0, 1e-9);
  EXPECT_EQ(memory_.rivals[1].T_map_base.x, -8.0);
}

TEST_F(RecoveryTest, AWinnerIsToBeConfirmedUnlessThePoseIsRefuted) {
  const Recovery recovery(
      RecoveryOptions{.rival_beams = FoundElsewhere::kBeams, .accept = 1.0, .sure = 1.0, .confirm = 2}, 1);
  memory_.rivals = {{{5, 0, 0}, 3.0}};
  EXPECT_FALSE(recovery.take_over(memory_, kBelieved, Standing::kTrusted, filter_));
  memory_.rivals[0].scans = 2;
  EXPECT_TRUE(recovery.take_over(memory_, kBelieved, Standing::kTrusted, filter_));
  memory_.rivals = {{{9, 0, 0}, 3.0}};
  EXPECT_TRUE(recovery.take_over(memory_, kBelieved, Standing::kRefuted, filter_));
}

// A symmetric building: to choose one of two places would be wrong every other time.
TEST_F(RecoveryTest, WhereTwoPlacesFitAlikeNoneTakesOver) {
  memory_.rivals = {{{5, 0, 0}, 6.0}, {{9, 0, 0}, 6.0}};
  EXPECT_FALSE(recovery_.take_over(memory_, kBelieved, Standing::kDoubtful, filter_));
  memory_.rivals[1].log_odds = 3.0;
  EXPECT_TRUE(recovery_.take_over(memory_, kBelieved, Standing::kDoubtful, filter_));
}

// ... but both are better than a belief that is refuted; the other one stays a rival.
TEST_F(RecoveryTest, OneOfTwoPlacesTakesOverFromAHopelessBelief) {
  memory_.rivals = {{{5, 0, 0}, 12.0}, {{9, 0, 0}, 12.0}};
  EXPECT_TRUE(recovery_.take_over(memory_, kBelieved, Standing::kDoubtful, filter_));
  EXPECT_NEAR(Rivals::believed_share(memory_.rivals), 0.5, 1e-4);
}

// A crowd: what the map does not explain is no sign of a wrong place, and another one may well explain it.
TEST_F(RecoveryTest, WhereTheMonitorHasNoDoubtItTakesMore) {
  memory_.rivals = {{{5, 0, 0}, 8.4}};
  EXPECT_FALSE(recovery_.take_over(memory_, kBelieved, Standing::kTrusted, filter_));
  memory_.rivals[0].log_odds = 8.6;  // accept 0.5 and sure 8
  EXPECT_TRUE(recovery_.take_over(memory_, kBelieved, Standing::kTrusted, filter_));
}

// People in the way block beams; that many beams pass through walls only from a wrong place, and one scan
// tells.
TEST_F(RecoveryTest, BeamsThroughWallsRefuteWhateverTheMonitorSays) {
  EXPECT_EQ(
      recovery_.standing(0.95, BeamShares{.explained = 0.3, .blocked = 0.65, .beyond = 0.05, .beams = 60}),
      Standing::kTrusted);
  EXPECT_EQ(
      recovery_.standing(0.95, BeamShares{.explained = 0.5, .beyond = 0.2, .unknown = 0.3, .beams = 60}),
      Standing::kRefuted);
  EXPECT_EQ(recovery_.standing(0.95, BeamShares{.explained = 0.5, .beyond = 0.5, .beams = 1}),
            Standing::kTrusted)
      << "a single beam";
  EXPECT_EQ(recovery_.standing(0.5, BeamShares{.explained = 1.0, .beams = 60}), Standing::kDoubtful);
  EXPECT_EQ(recovery_.standing(0.95, std::nullopt), Standing::kTrusted) << "a sensor without beams";
}

TEST_F(RecoveryTest, ARefutedBeliefGivesWayToWhatIsMoreProbableThanAllElse) {
  const Recovery recovery(RecoveryOptions{}, 1);
  memory_.rivals = {{{5, 0, 0}, 1.2}};
  EXPECT_FALSE(recovery.take_over(memory_, kBelieved, Standing::kDoubtful, filter_));
  EXPECT_TRUE(recovery.take_over(memory_, kBelieved, Standing::kRefuted, filter_));
  memory_.rivals = {{{5, 0, 0}, 1.2}, {{9, 0, 0}, 1.2}};
  EXPECT_FALSE(recovery.take_over(memory_, kBelieved, Standing::kRefuted, filter_));
}

TEST_F(RecoveryTest, OneOfManyPlacesDoesNot) {
  for (const double log_odds : {12.0, 5000.0}) {
    memory_.rivals.clear();
    for (int i = 0; i < 4; ++i) memory_.rivals.push_back({{5.0 + 3.0 * i, 0, 0}, log_odds});
    EXPECT_FALSE(recovery_.take_over(memory_, kBelieved, Standing::kDoubtful, filter_));
  }
}

// What stands in the way is seen again and again from nearby.
TEST_F(RecoveryTest, AScanCountsAsFarAsItIsNews) {
  const FoundElsewhere model(2.0);
  memory_.rivals = {{{5, 0, 0}, 0.0}};
  observe(model, 0.0, true);  // the robot has not moved
  EXPECT_EQ(memory_.rivals[0].log_odds, 0.0);
  Recovery::carry(memory_, {0.125, 0.0, 0.0}, 1.0);
  observe(model, 1.0, true);
  EXPECT_NEAR(memory_.rivals[0].log_odds, 1.0, 1e-9);  // half of the way of a whole scan
  Recovery::carry(memory_, {0.125, 0.0, 0.3}, 1.0);
  observe(model, 2.0, true);
  EXPECT_NEAR(memory_.rivals[0].log_odds, 3.0, 1e-9);
}

TEST_F(RecoveryTest, ABeliefThatExplainsTheScansAsWellIsNotDisturbed) {
  EXPECT_FALSE(after_one_scan(0.0));
  EXPECT_TRUE(filter_.states_.empty());
}

TEST_F(RecoveryTest, DoubtComesFromTheJudgementOrFromFewerExplainedBeamsThanUsual) {
  EXPECT_FALSE(recovery_.doubtful(0.99, 0.85, 0.9));
  EXPECT_TRUE(recovery_.doubtful(0.5, 0.9, 0.9));
  EXPECT_TRUE(recovery_.doubtful(0.99, 0.7, 0.9));
  EXPECT_FALSE(recovery_.surprising(0.9, 0.7));
  EXPECT_TRUE(recovery_.surprising(0.9, 0.5));
}

TEST_F(RecoveryTest, WhoIsNotInDoubtIsNotLookedFor) {
  const FoundElsewhere model(50.0);
  observe(model, 1.0, false);
  recovery_.search(memory_, model, at(1.0), {});
  EXPECT_EQ(model.searches, 0);
}

TEST_F(RecoveryTest, SearchesBecomeRareWhileTheDoubtLasts) {
  const FoundElsewhere model(-20.0);
  for (int i = 0; i < 600; ++i) {
    observe(model, 0.1 * i, true);
    recovery_.search(memory_, model, at(0.1 * i), {});
  }
  EXPECT_GE(model.searches, 15);
  EXPECT_LE(model.searches, 16);  // every 4 s: the first wait is doubled at once
}

TEST_F(RecoveryTest, TheScansOfTheDoubtAreJoinedAsTheRobotMoved) {
  const FoundElsewhere model(-20.0);
  const Pose2 step{0.3, 0.0, 0.1};
  observe(model, 0.0, false);  // before the doubt
  for (int i = 1; i <= 4; ++i) {
    Recovery::carry(memory_, step, 1.0);
    observe(model, i, true);
  }
  recovery_.search(memory_, model, at(4.0), {});
  ASSERT_EQ(model.searched_with.size(), 4u);
  const Pose2 expected = inverse(step * step * step);
  EXPECT_LT(distance(model.searched_with[0].T_now_then, expected), 1e-9);
  EXPECT_NEAR(model.searched_with[0].T_now_then.theta, expected.theta, 1e-9);
  EXPECT_EQ(model.searched_with[3].T_now_then.x, 0.0);
}

TEST_F(RecoveryTest, ScansNearToEachOtherAreNotJoinedTwice) {
  const FoundElsewhere model(-20.0);
  for (int i = 0; i < 100; ++i) {
    Recovery::carry(memory_, {0.05, 0.0, 0.0}, 0.1);
    observe(model, 0.1 * i, true);
  }
  EXPECT_LE(memory_.glimpses.size(), 8u);
  EXPECT_LT(memory_.glimpses.front().T_now_then.x, -0.8);
}

// Two corridors look alike on the map: only that the scans do not go on tells that the robot is in the other
// one.
TEST_F(RecoveryTest, AScanThatDoesNotGoOnRaisesDoubtAndASearch) {
  const FoundElsewhere model(1.0);
  memory_.rivals = {{{5, 0, 0}, 3.0}};
  recovery_.note(memory_, recovery_.link(0.9), at(1.0));
  EXPECT_FALSE(memory_.carried);
  recovery_.note(memory_, recovery_.link(0.5), at(1.0));
  EXPECT_TRUE(memory_.carried);
  EXPECT_TRUE(memory_.rivals.empty()) << "they were places before it";
  observe(model, 1.0, memory_.carried);
  recovery_.search(memory_, model, at(1.0), {});
  ASSERT_EQ(memory_.rivals.size(), 1u);
  EXPECT_NEAR(memory_.rivals[0].log_odds, 1.0, 1e-9) << "even odds, and what the scan fits better";
}

TEST_F(RecoveryTest, AfterSuchAScanTheMonitorIsNotTrusted) {
  memory_.rivals = {{{5, 0, 0}, 4.0}};
  EXPECT_FALSE(recovery_.take_over(memory_, kBelieved, Standing::kTrusted, filter_));
  memory_.carried = true;
  EXPECT_TRUE(recovery_.take_over(memory_, kBelieved, Standing::kTrusted, filter_));
}

TEST_F(RecoveryTest, ScansThatGoOnSettleWhereTheRobotIs) {
  recovery_.note(memory_, Link::kBroken, at(1.0));
  const auto drive = [&](double way_m) {
    Recovery::carry(memory_, {way_m, 0.0, 0.0}, 1.0);
    memory_.doubted_m = 0.0;
    recovery_.settle(memory_, 0.99, Standing::kTrusted);
  };
  drive(1.9);
  EXPECT_TRUE(memory_.carried);
  recovery_.note(memory_, Link::kBroken, at(2.0));  // once more: it begins anew
  drive(1.9);
  EXPECT_TRUE(memory_.carried);
  memory_.rivals = {{{5, 0, 0}, -2.0}};
  drive(0.2);
  EXPECT_TRUE(memory_.carried) << "one of eight for the rival";
  memory_.rivals[0].log_odds = -6.0;
  drive(0.0);
  EXPECT_FALSE(memory_.carried);
  EXPECT_TRUE(memory_.rivals.empty());
  EXPECT_TRUE(recovery_.anchored(memory_));
}

// Where scans are too far apart to be compared, a robot that was carried away is settled by its way alone.
TEST_F(RecoveryTest, ScansThatCannotBeComparedDoNotUnsettle) {
  recovery_.note(memory_, Link::kBroken, at(1.0));
  Recovery::carry(memory_, {1.9, 0.0, 0.0}, 1.0);
  recovery_.note(memory_, Link::kUnknown, at(2.0));
  Recovery::carry(memory_, {0.2, 0.0, 0.0}, 1.0);
  memory_.doubted_m = 0.0;
  recovery_.settle(memory_, 0.99, Standing::kTrusted);
  EXPECT_FALSE(memory_.carried);
}

TEST_F(RecoveryTest, EachScanThatDoesNotGoOnIsSearchedWithButNotTenASecond) {
  const FoundElsewhere model(-20.0);
  const auto searches_after_break = [&](double at_s) {
    recovery_.note(memory_, Link::kBroken, at(at_s));
    observe(model, at_s, true);
    recovery_.search(memory_, model, at(at_s), {});
    return model.searches;
  };
  EXPECT_EQ(searches_after_break(1.0), 1);
  EXPECT_EQ(searches_after_break(1.2), 1);
  EXPECT_EQ(searches_after_break(1.6), 2);
  EXPECT_EQ(model.searched_with.size(), 1u) << "what was seen before is of another place";
}

TEST_F(RecoveryTest, APlaceThatHasTakenOverIsSettledLater) {
  memory_.rivals = {{{5, 0, 0}, 12.0}};
  ASSERT_TRUE(recovery_.take_over(memory_, kBelieved, Standing::kDoubtful, filter_));
  memory_.rivals.clear();
  for (int metre = 1; metre <= RecoveryOptions{}.settle_m; ++metre) {
    EXPECT_TRUE(memory_.carried) << metre;
    Recovery::carry(memory_, {1.0, 0.0, 0.0}, 1.0);
    memory_.doubted_m = 0.0;
    recovery_.settle(memory_, 0.99, Standing::kTrusted);
  }
  EXPECT_FALSE(memory_.carried);
}

TEST_F(RecoveryTest, AnAnchorIsLostToWhatSpeaksAgainstThePose) {
  const auto anchored_after = [&](Link link, double right, Standing standing, double doubted_m) {
    memory_ = recovery_.begin(false);
    memory_.doubted_m = doubted_m;
    recovery_.note(memory_, link, at(1.0));
    recovery_.settle(memory_, right, standing);
    return recovery_.anchored(memory_);
  };
  EXPECT_TRUE(anchored_after(Link::kHolds, 0.5, Standing::kDoubtful, 1.5)) << "the map is wrong here";
  EXPECT_FALSE(anchored_after(Link::kUnknown, 0.5, Standing::kDoubtful, 1.5)) << "scans too far apart";
  EXPECT_FALSE(anchored_after(Link::kBroken, 0.5, Standing::kDoubtful, 1.5));
  EXPECT_FALSE(anchored_after(Link::kHolds, 0.05, Standing::kDoubtful, 1.5));
  EXPECT_FALSE(anchored_after(Link::kHolds, 0.5, Standing::kRefuted, 1.5));
  EXPECT_FALSE(anchored_after(Link::kHolds, 0.5, Standing::kDoubtful, 2.5)) << "for too long";
  EXPECT_FALSE(recovery_.anchored(recovery_.begin(true))) << "a start anywhere";
}

TEST_F(RecoveryTest, WithoutLinksNothingIsAnchored) {
  RecoveryOptions options;
  options.continued = 0.0;
  const Recovery recovery(options, 1);
  EXPECT_EQ(recovery.link(0.1), Link::kUnknown);
  EXPECT_FALSE(recovery.anchored(recovery.begin(false)));
}

TEST_F(RecoveryTest, TheSameMeasurementsBringTheSamePosesIn) {
  EXPECT_TRUE(after_one_scan(2.9));
  const std::vector<Pose2> first = filter_.states_;
  EXPECT_TRUE(after_one_scan(2.9));
  EXPECT_EQ(first, filter_.states_);
}

}  // namespace
}  // namespace cairn
