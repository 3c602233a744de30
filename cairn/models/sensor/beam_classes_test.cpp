#include "cairn/models/sensor/beam_classes.hpp"

#include "mini_maps.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

class BeamClasses : public testing::Test {
 protected:
  static BeamClassifier classifier(const OccupancyGrid& map) {
    return {std::make_shared<const OccupancyGrid>(map), std::make_shared<const DistanceField>(map, 2.0),
            std::make_shared<const RayMarcher>(map, 50.0), Pose2{}, BeamLimits{}};
  }

  OccupancyGrid map_ = test::mini_room();
  BeamClassifier classifier_ = classifier(map_);
  Pose2 truth_{3.0, 2.0, 0.4};
  LaserScan scan_ = test::scan_of(map_, truth_, 180);
};

TEST_F(BeamClasses, FromTheTruePoseTheMapExplainsAll) {
  const BeamShares shares = classifier_.classify(scan_, truth_);
  EXPECT_EQ(shares.beams, 60);
  EXPECT_NEAR(shares.explained, 1.0, 1e-9);
  EXPECT_NEAR(shares.fit, 0.0, 0.05);
}

// 12 cm off, all end within the tolerance, most of them beside their wall.
TEST_F(BeamClasses, ResidualsAreOfExplainedBeamsOnly) {
  EXPECT_LT(classifier_.classify(scan_, truth_).residual, 0.1);
  const BeamShares beside = classifier_.classify(scan_, truth_ * Pose2{0.12, 0.0, 0.0});
  EXPECT_NEAR(beside.explained, 1.0, 0.05);
  EXPECT_GT(beside.residual, 0.2);
  EXPECT_LE(beside.residual, 0.5 * 0.12 * 0.12 / 0.01 + 0.3);  // and what a cell rounds
  for (float& range_m : scan_.ranges_m) range_m = 0.2f;
  EXPECT_EQ(classifier_.classify(scan_, truth_).residual, 0.0);
}

TEST_F(BeamClasses, PeopleBlockBeamsButLetNoneThroughWalls) {
  // The box, 0.7 m away, is nearest of all that is mapped.
  for (std::size_t i = 0; i < 90; ++i) scan_.ranges_m[i] = std::min(scan_.ranges_m[i], 0.4f);
  const BeamShares shares = classifier_.classify(scan_, truth_);
  EXPECT_NEAR(shares.blocked, 0.5, 1e-9);
  EXPECT_NEAR(shares.explained, 0.5, 1e-9);
  EXPECT_EQ(shares.beyond, 0.0);
  EXPECT_LT(shares.fit, -0.5);
}

// At 0.6 m, towards the corner of the box, the beams of 0.36 rad end within the tolerance of 0.16 m beside
// it.
TEST_F(BeamClasses, WhoStandsBesideAMappedThingCountsAsThatThing) {
  for (std::size_t i = 0; i < 90; ++i) scan_.ranges_m[i] = std::min(scan_.ranges_m[i], 0.6f);
  const BeamShares shares = classifier_.classify(scan_, truth_);
  EXPECT_NEAR(shares.blocked, 0.5 - 0.36 / 6.28, 1.0 / 60);
  EXPECT_NEAR(shares.explained, 0.5 + 0.36 / 6.28, 1.0 / 60);
}

TEST_F(BeamClasses, FromAWrongPoseBeamsPassThroughWalls) {
  const BeamShares shares = classifier_.classify(scan_, {6.8, 1.2, 2.5});
  EXPECT_LT(shares.explained, 0.7);
  EXPECT_GT(shares.beyond + shares.unknown, 0.15);
}

TEST_F(BeamClasses, SharesSumToOne) {
  for (const Pose2& pose : {truth_, Pose2{1, 1, 0}, Pose2{7, 2, 3}, Pose2{-5, -5, 1}, Pose2{1e7, 0, 0}}) {
    const BeamShares s = classifier_.classify(scan_, pose);
    EXPECT_NEAR(s.explained + s.blocked + s.beyond + s.unknown, 1.0, 1e-9);
    EXPECT_LE(s.fit, 0.0);
  }
}

TEST_F(BeamClasses, WhatEndsWhereNothingIsMappedSpeaksForNothing) {
  const OccupancyGrid map = test::draw_grid({"????????", "#  #????", "#  #????", "####????"}, 1.0);
  LaserScan scan{{}, 0.0, 0.01, 0.1, 30.0, {5.5f, 5.5f}};  // through the right wall
  const BeamShares shares = classifier(map).classify(scan, {1.5, 1.5, 0.0});
  EXPECT_EQ(shares.unknown, 1.0);
}

TEST_F(BeamClasses, OnTheMapAreTheSharesOfWhatEndsThere) {
  const BeamShares half{.explained = 0.3,
                        .blocked = 0.1,
                        .beyond = 0.1,
                        .unknown = 0.5,
                        .fit = 0.5 * std::log(0.15),
                        .beams = 60};
  const BeamShares known = on_the_map(half);
  EXPECT_NEAR(known.explained, 0.6, 1e-12);
  EXPECT_NEAR(known.blocked, 0.2, 1e-12);
  EXPECT_NEAR(known.beyond, 0.2, 1e-12);
  EXPECT_EQ(known.unknown, 0.0);
  EXPECT_NEAR(known.fit, 0.0, 1e-12);
  EXPECT_EQ(known.beams, 30);
  EXPECT_EQ(on_the_map({.unknown = 1.0, .beams = 60}).beams, 0);
}

TEST_F(BeamClasses, AScanWithoutABeamSaysNothing) {
  scan_.ranges_m.assign(scan_.ranges_m.size(), 0.0f);
  EXPECT_EQ(classifier_.classify(scan_, truth_).beams, 0);
  EXPECT_GT(classifier_.classify(scan_, truth_).missing, 0.9);  // though there are walls all around
  EXPECT_EQ(classifier_.classify(LaserScan{}, truth_).beams, 0);
}

}  // namespace
}  // namespace cairn
