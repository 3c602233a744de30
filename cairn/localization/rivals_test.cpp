#include "cairn/localization/rivals.hpp"

#include "fake_fusion.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

/// A scan fits as well as the place is near to the true one.
class FitsThere final : public StreamModel {
 public:
  FitsThere(const Pose2& truth, double everywhere) : truth_(truth), everywhere_(everywhere) {}
  BoundUpdate<Pose2> bind(const Event::Payload&, bool) const override { return {}; }
  double explained_share(const Event::Payload&, const Pose2&) const override { return 1.0; }
  double beams(const Event::Payload&) const override { return 1.0; }
  bool informs(const Event::Payload&) const override { return true; }
  bool follow(const Event::Payload&, std::span<Pose2> places, std::span<double> fits) const override {
    for (std::size_t i = 0; i < places.size(); ++i)
      fits[i] = everywhere_ - (distance(places[i], truth_) < 0.5 ? 0.0 : 0.4);
    return true;
  }

 private:
  Pose2 truth_;
  double everywhere_;
};

class RivalsTest : public testing::Test {
 protected:
  void weigh(const StreamModel& model, int scans) {
    for (int i = 0; i < scans; ++i) rivals_.weigh(all_, model, test::fake_measurement(i).payload, believed_);
  }

  Pose2 believed_{0.0, 0.0, 0.0};
  Rivals rivals_{{.beams = 5.0}};
  std::vector<Rival> all_;
};

TEST_F(RivalsTest, TheTruePlaceWinsScanByScan) {
  rivals_.add(all_, {{5, 0, 0}, -8.0}, believed_);
  rivals_.add(all_, {{9, 0, 0}, -4.0}, believed_);
  weigh(FitsThere({5, 0, 0}, -0.1), 3);
  EXPECT_NEAR(all_[1].log_odds, -4.0, 1e-12);  // it fits as badly as the belief
  EXPECT_EQ(Rivals::strongest(all_, 3)->T_map_base.x, 5.0);
  EXPECT_NEAR(Rivals::strongest(all_, 3)->log_odds, -8.0 + 3 * 5.0 * 0.4, 1e-12);
}

TEST_F(RivalsTest, WhatSpoilsAllPlacesAlikeFavoursNone) {
  rivals_.add(all_, {{5, 0, 0}, -3.0}, believed_);
  weigh(FitsThere({-50, 0, 0}, -1.9), 100);  // the robot stands among people
  EXPECT_DOUBLE_EQ(all_.front().log_odds, -3.0);
}

TEST_F(RivalsTest, TheHopelessAreGivenUp) {
  rivals_.add(all_, {{5, 0, 0}, -3.0}, believed_);
  weigh(FitsThere({0, 0, 0}, 0.0), 4);
  EXPECT_EQ(all_.size(), 1u);
  weigh(FitsThere({0, 0, 0}, 0.0), 1);
  EXPECT_TRUE(all_.empty());
}

TEST_F(RivalsTest, OneScanNeverSaysMoreThanTheLargest) {
  const Rivals rivals({.beams = 1000.0, .largest = 3.0});
  rivals.add(all_, {{5, 0, 0}, -3.0}, believed_);
  rivals.weigh(all_, FitsThere({5, 0, 0}, 0.0), test::fake_measurement(0.0).payload, believed_);
  EXPECT_DOUBLE_EQ(all_.front().log_odds, 0.0);
}

// The floor is that of each place: next to a belief that is quite wrong, a good rival still beats a fair one.
TEST_F(RivalsTest, RivalsOfAHopelessBeliefStillDiffer) {
  const Rivals rivals({.beams = 10.0, .largest = 10.0});
  EXPECT_DOUBLE_EQ(rivals.evidence(-3.0), -10.0);
  EXPECT_DOUBLE_EQ(rivals.evidence(-0.2) - rivals.evidence(-0.5), 3.0);
}

TEST_F(RivalsTest, APlaceIsKnownOnce) {
  rivals_.add(all_, {{5, 0, 0}, -3.0}, believed_);
  rivals_.add(all_, {{5.3, 0, 0.1}, 2.0}, believed_);
  rivals_.add(all_, {{0.2, 0, 0}, 2.0}, believed_);  // that is where it is believed
  ASSERT_EQ(all_.size(), 1u);
  EXPECT_DOUBLE_EQ(all_.front().log_odds, -3.0);
  rivals_.add(all_, {{5, 0, 3.0}, -4.0}, believed_);  // another heading is another place
  EXPECT_EQ(all_.size(), 2u);
}

TEST_F(RivalsTest, TheDefeatedBeliefBecomesARival) {
  rivals_.add(all_, {{5, 0, 0}, 4.0}, believed_);
  rivals_.add(all_, {{9, 0, 0}, 1.0}, believed_);
  const Rival won = rivals_.take_over(all_, *Rivals::strongest(all_, 0), believed_);
  EXPECT_EQ(won.T_map_base.x, 5.0);
  ASSERT_EQ(all_.size(), 2u);
  EXPECT_EQ(all_[0].T_map_base.x, 9.0);
  EXPECT_DOUBLE_EQ(all_[0].log_odds, -3.0);
  EXPECT_EQ(all_[1].T_map_base.x, 0.0);
  EXPECT_DOUBLE_EQ(all_[1].log_odds, -4.0);
}

TEST_F(RivalsTest, SharesSumToOne) {
  EXPECT_EQ(Rivals::believed_share(all_), 1.0);
  rivals_.add(all_, {{5, 0, 0}, std::log(2.0)}, believed_);
  rivals_.add(all_, {{9, 0, 0}, 0.0}, believed_);
  EXPECT_NEAR(Rivals::believed_share(all_), 0.25, 1e-12);
}

// A refuted belief that nothing may take over from: its rivals gain for as long as that lasts.
TEST_F(RivalsTest, SharesOfAnyOddsAreNumbers) {
  all_ = {{{5, 0, 0}, 5000.0}, {{9, 0, 0}, 5000.0}, {{13, 0, 0}, -5000.0}};
  EXPECT_NEAR(Rivals::share(all_, 5000.0), 0.5, 1e-12);
  EXPECT_EQ(Rivals::share(all_, -5000.0), 0.0);
  EXPECT_EQ(Rivals::believed_share(all_), 0.0);
}

// What spoke for the rival speaks for the place that both are now, against all others.
TEST_F(RivalsTest, ABeliefThatComesToARivalHasItsOdds) {
  all_ = {{{0.1, 0, 0}, 50.0}, {{9, 0, 0}, 48.0}};
  weigh(FitsThere({-50, 0, 0}, -0.1), 1);  // it fits equally badly everywhere
  ASSERT_EQ(all_.size(), 1u);
  EXPECT_EQ(all_[0].T_map_base.x, 9.0);
  EXPECT_NEAR(all_[0].log_odds, -2.0, 1e-9);
}

TEST_F(RivalsTest, RivalsDriveAlong) {
  all_ = {{{5, 0, 1.5707963267948966}, 0.0}};
  Rivals::carry(all_, {1.0, 0.0, 0.0}, 2.0);
  EXPECT_NEAR(all_[0].T_map_base.y, 1.0, 1e-12);
  EXPECT_EQ(all_[0].age_s, 2.0);
}

}  // namespace
}  // namespace cairn
