#include "cairn/localization/monitor.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

BeamShares shares(double explained, double blocked, double beyond) {
  BeamShares s{explained, blocked, beyond, 1.0 - explained - blocked - beyond, 0.0, 60};
  s.fit = -1.9 * (1.0 - explained);  // as if each unexplained beam were far from every wall
  return s;
}
const BeamShares kUsual = shares(0.92, 0.05, 0.02);
const BeamShares kCrowd = shares(0.40, 0.58, 0.01);
const BeamShares kElsewhere = shares(0.45, 0.25, 0.25);
const BeamShares kNothing{.missing = 1.0};
const BeamShares kOpenPlace{.missing = 0.1};

class MonitorTest : public testing::Test {
 protected:
  Judgement look(const BeamShares& seen, int times = 1) {
    Judgement judgement;
    for (int i = 0; i < times; ++i) judgement = monitor_.update(memory_, {0, seen, 0.0, places_, 0.02});
    return judgement;
  }

  Monitor monitor_{MonitorOptions{}};
  MonitorMemory memory_ = Monitor::begin(1, false);
  std::vector<Hypothesis> places_ = {{Pose2{}, 1e-3 * Eigen::Matrix3d::Identity(), 1.0, 5.0}};
};

TEST_F(MonitorTest, AGoodScanIsTracking) {
  const Judgement judgement = look(kUsual, 20);
  EXPECT_EQ(judgement.state, TrackingState::kTracking);
  EXPECT_GT(judgement.probability, 0.98);
  EXPECT_EQ(judgement.explained, kUsual.explained);
}

TEST_F(MonitorTest, ACrowdIsNotAWrongPlace) {
  look(kUsual, 20);
  const Judgement judgement = look(kCrowd, 50);
  EXPECT_EQ(judgement.state, TrackingState::kCrowded);
  EXPECT_GT(judgement.probability, 0.5);
}

TEST_F(MonitorTest, AWrongPlaceIsLostAfterAFewScans) {
  look(kUsual, 500);  // a long good time must not make blind
  int scans = 1;
  while (look(kElsewhere).state != TrackingState::kLost && scans < 100) ++scans;
  EXPECT_LE(scans, 8);
  EXPECT_LT(look(kElsewhere, 5).probability, 0.2);
  EXPECT_GT(look(kUsual, 40).probability, 0.9);  // and back
}

TEST_F(MonitorTest, EvidenceCountsAsFarAsTheBeamsThatItIsOf) {
  monitor_.update(memory_, {.seen = kElsewhere, .places = places_, .share = 0.0});
  const double untouched = memory_.log_odds;
  EXPECT_EQ(memory_.last_evidence, 0.0);
  monitor_.update(memory_, {.seen = kElsewhere, .places = places_});
  const double whole = memory_.last_evidence;
  monitor_.update(memory_, {.seen = kElsewhere, .places = places_, .share = 0.5});
  EXPECT_NEAR(memory_.last_evidence, 0.5 * whole, 1e-12);
  EXPECT_LT(memory_.log_odds, untouched);
}

// Another scanner speaks for the pose; later it is silent for a while, or speaks against it, too.
TEST_F(MonitorTest, AScannerThatNothingFitsIsKnownForThat) {
  EXPECT_TRUE(Monitor::fits(memory_, 0));
  Judgement judgement;
  for (int i = 0; i < 30; ++i)
    judgement = monitor_.update(memory_, {.seen = kElsewhere, .places = places_, .vouched = true});
  EXPECT_GT(judgement.probability, 0.9);
  EXPECT_FALSE(Monitor::fits(memory_, 0));
  EXPECT_GT(look(kElsewhere, 10).probability, 0.9);
  Monitor::believe(memory_, 0);
  EXPECT_TRUE(Monitor::fits(memory_, 0));
  EXPECT_LT(look(kElsewhere, 10).probability, 0.5);
}

TEST_F(MonitorTest, AScannerThatFitsIsHeardWhenNobodyVouches) {
  for (int i = 0; i < 30; ++i) monitor_.update(memory_, {.seen = kUsual, .places = places_, .vouched = true});
  EXPECT_TRUE(Monitor::fits(memory_, 0));
  EXPECT_LT(look(kElsewhere, 10).probability, 0.5);
}

// What it was known for is void; one that has won against all others is more likely than not.
TEST_F(MonitorTest, AnotherPlaceIsJudgedAnew) {
  look(kUsual, 20);
  Monitor::start_over(memory_);
  EXPECT_EQ(monitor_.right(memory_), 0.5);
  Monitor::take_over(memory_);
  EXPECT_NEAR(monitor_.right(memory_), 0.9, 0.05);
  EXPECT_LT(look(kElsewhere, 3).probability, 0.5);
}

// A place that the map has drawn the pose to is explained well.
TEST_F(MonitorTest, APoseThatLeavesTheRobotsMotionIsDoubted) {
  const auto drifted = [&](double drift_m) {
    return monitor_.update(memory_, {.seen = kUsual, .places = places_, .drift_m = drift_m});
  };
  const double usual = look(kUsual, 20).probability;
  EXPECT_GT(drifted(0.3).probability, 0.99 * usual);
  EXPECT_NEAR(drifted(0.7).probability, 0.5 * usual, 1e-3);
  const Judgement far = drifted(1.2);
  EXPECT_LT(far.probability, 0.05);
  EXPECT_EQ(far.state, TrackingState::kAmbiguous);
  EXPECT_EQ(far.drift, 1.2);
  EXPECT_NE(explain(far).find("1.20 m away from the robot's own motion"), std::string::npos) << explain(far);
  EXPECT_GT(monitor_.right_by_scans(memory_), 0.99);
  EXPECT_GT(drifted(0.0).probability, 0.99 * usual);  // nothing has added up
}

TEST_F(MonitorTest, TheDriftOfAPlaceThatIsGivenUpIsForgotten) {
  monitor_.update(memory_, {.seen = kUsual, .places = places_, .drift_m = 2.0});
  Monitor::take_over(memory_);
  EXPECT_GT(monitor_.right(memory_), 0.8);
  monitor_.update(memory_, {.seen = kUsual, .places = places_, .drift_m = 2.0});
  Monitor::start_over(memory_);
  EXPECT_EQ(monitor_.right(memory_), 0.5);
}

TEST_F(MonitorTest, NoDriftCountsWhereItIsSwitchedOff) {
  const Monitor monitor({.drift_m = 0.0});
  const Judgement judgement = monitor.update(memory_, {.seen = kUsual, .places = places_, .drift_m = 100.0});
  EXPECT_GT(judgement.probability, 0.9);
  EXPECT_EQ(judgement.state, TrackingState::kTracking);
}

TEST_F(MonitorTest, OneBadScanIsNotEnough) {
  look(kUsual, 20);
  EXPECT_EQ(look(kElsewhere).state, TrackingState::kTracking);
}

TEST_F(MonitorTest, SeveralPlacesAreAmbiguous) {
  const Eigen::Matrix3d narrow = 1e-3 * Eigen::Matrix3d::Identity();
  places_ = {{Pose2{}, narrow, 0.5, 1.0}, {Pose2{5, 0, 0}, narrow, 0.5, 1.0}};
  const Judgement judgement = look(kUsual, 20);
  EXPECT_EQ(judgement.state, TrackingState::kAmbiguous);
  EXPECT_LE(judgement.probability, 0.5);
  EXPECT_NEAR(judgement.entropy, std::log(2.0), 1e-12);
}

TEST_F(MonitorTest, AWidePlaceIsAmbiguous) {
  places_[0].covariance(0, 0) = 4.0;
  EXPECT_EQ(look(kUsual, 20).state, TrackingState::kAmbiguous);
}

TEST_F(MonitorTest, BlindScansAreASensorFaultAndSayNothing) {
  const double before = look(kUsual, 20).probability;
  EXPECT_EQ(look(kNothing, 4).state, TrackingState::kTracking);
  const Judgement judgement = look(kNothing);
  EXPECT_EQ(judgement.state, TrackingState::kSensorFault);
  EXPECT_EQ(judgement.probability, before);
  EXPECT_EQ(look(kUsual).state, TrackingState::kTracking);
}

TEST_F(MonitorTest, AnOpenPlaceIsNoFault) {
  EXPECT_EQ(look(kOpenPlace, 100).state, TrackingState::kTracking);
}

TEST_F(MonitorTest, ASensorWithoutClassesOfBeamsContributesWhatItExplains) {
  const auto judge = [&](double quality) {
    MonitorMemory memory = Monitor::begin(1, true);
    Judgement judgement;
    for (int i = 0; i < 10; ++i)
      judgement = monitor_.update(memory, {0, std::nullopt, quality, places_, 0.02});
    return judgement;
  };
  EXPECT_EQ(judge(0.95).state, TrackingState::kTracking);
  EXPECT_EQ(judge(0.2).state, TrackingState::kLost);
}

TEST_F(MonitorTest, FiguresAreFiniteWhateverComes) {
  for (const BeamShares& seen : {kNothing, shares(1, 0, 0), shares(0, 0, 1), shares(0, 1, 0)}) {
    const Judgement judgement = look(seen, 10000);
    EXPECT_TRUE(judgement.probability >= 0.0 && judgement.probability <= 1.0);
  }
}

TEST_F(MonitorTest, EveryStateHasAReason) {
  for (std::size_t i = 0; i < kTrackingStateCount; ++i) {
    Judgement judgement;
    judgement.state = static_cast<TrackingState>(i);
    EXPECT_GT(explain(judgement).size(), 20u);
    EXPECT_STRNE(to_string(judgement.state), "unknown");
  }
}

}  // namespace
}  // namespace cairn
