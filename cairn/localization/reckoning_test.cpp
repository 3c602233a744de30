#include "cairn/localization/reckoning.hpp"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// Knows where the robot was when each scan was taken: the scan holds its number.
class KnowsTheWay final : public StreamModel {
 public:
  Event::Payload scan_at(const Pose2& truth) {
    truths_.push_back(truth);
    auto scan = std::make_shared<LaserScan>();
    scan->ranges_m = {static_cast<float>(truths_.size() - 1)};
    return std::shared_ptr<const LaserScan>(std::move(scan));
  }
  BoundUpdate<Pose2> bind(const Event::Payload& /*z*/, bool /*compact*/) const override { return {}; }
  bool informs(const Event::Payload& /*z*/) const override { return true; }
  double explained_share(const Event::Payload& /*z*/, const Pose2& /*pose*/) const override { return 1.0; }
  double beams(const Event::Payload& /*z*/) const override { return 1.0; }
  bool can_compare(const Event::Payload& /*z*/) const override { return sees; }
  std::optional<double> closeness(const Event::Payload& before, const Event::Payload& now,
                                  const Pose2& T_before_now) const override {
    const Pose2 moved = inverse(truth(before)) * truth(now);
    return featureless ? 0.8 : std::exp(-3.0 * distance(moved, T_before_now));
  }

  bool sees = true;
  bool featureless = false;  // a corridor: each motion fits alike

 private:
  const Pose2& truth(const Event::Payload& z) const {
    return truths_[static_cast<std::size_t>(std::get<std::shared_ptr<const LaserScan>>(z)->ranges_m[0])];
  }
  std::vector<Pose2> truths_;
};

/// A robot that drives along the x axis, 10 cm from scan to scan.
class ReckoningTest : public ::testing::Test {
 protected:
  void SetUp() override { reckoning_.begin({}); }
  /// @param odometry, believed, truth: what a step of 10 cm comes to for each of them
  double drive(int steps, double odometry, double believed, double truth) {
    double drift = 0.0;
    for (int i = 0; i < steps; ++i) {
      truth_.x += truth;
      believed_.x += believed;
      reckoning_.carry({odometry, 0.0, 0.0});
      drift = reckoning_.observe(1, model_, model_.scan_at(truth_), believed_);
    }
    return drift;
  }

  Reckoning reckoning_;
  KnowsTheWay model_;
  Pose2 truth_, believed_;
};

TEST_F(ReckoningTest, ARightPoseDoesNotDrift) { EXPECT_NEAR(drive(200, 0.1, 0.1, 0.1), 0.0, 1e-9); }

// Two metres, and the map has drawn the pose one metre on.
TEST_F(ReckoningTest, APoseThatIsDrawnAlongDrifts) {
  drive(100, 0.1, 0.1, 0.1);
  const double drift = drive(20, 0.1, 0.15, 0.1);
  EXPECT_GT(drift, 0.7);
  EXPECT_LT(drift, 1.0);
  EXPECT_LT(drive(50, 0.1, 0.1, 0.1), 0.5 * drift);  // 5 m on most of it is forgotten
}

TEST_F(ReckoningTest, ItIsSeenInACorridorToo) {
  model_.featureless = true;
  EXPECT_GT(drive(20, 0.1, 0.15, 0.1), 0.7);
}

TEST_F(ReckoningTest, OdometryThatErrsIsNotHeldAgainstThePose) {
  EXPECT_LT(drive(200, 0.13, 0.1, 0.1), 0.15);
  EXPECT_LT(drive(200, 0.07, 0.1, 0.1), 0.15);
}

// Where no scan tells, an error of 10 % comes to half a metre, and no more.
TEST_F(ReckoningTest, AConstantErrorComesToItsShareOfTheMemory) {
  model_.sees = false;
  EXPECT_NEAR(drive(1000, 0.11, 0.1, 0.1), 0.1 * Reckoning::kMemory_m, 0.1);
}

// The pose goes with the wheels at first, and is then put right by the map.
TEST_F(ReckoningTest, SlippingWheelsAreNotHeldAgainstThePose) {
  drive(50, 0.1, 0.1, 0.1);
  drive(8, 0.1, 0.1, 0.02);
  believed_ = truth_;
  EXPECT_LT(drive(8, 0.1, 0.1, 0.1), 0.3);
}

// People who walk along with the robot make its scans look as if it stood still.
TEST_F(ReckoningTest, ACrowdThatComesAlongIsNotHeldAgainstThePose) {
  EXPECT_LT(drive(200, 0.1, 0.1, 0.0), 1e-9);
}

TEST_F(ReckoningTest, WhatIsForgottenBeginsWithTheNextPose) {
  drive(20, 0.1, 0.1, 0.1);
  reckoning_.forget();
  believed_.x += 5.0;
  EXPECT_EQ(reckoning_.observe(1, model_, model_.scan_at(truth_), believed_), 0.0);
  EXPECT_NEAR(drive(20, 0.1, 0.1, 0.1), 0.0, 1e-9);
}

// Whether it has scans that could be compared or not: those of two scanners are never, and a step ends with
// the scanner that began it.
TEST_F(ReckoningTest, AnotherSensorBetweenTheScansChangesNothing) {
  for (const bool sees : {false, true}) {
    KnowsTheWay other;
    other.sees = sees;
    for (int i = 0; i < 200; ++i) {
      reckoning_.carry({0.065, 0.0, 0.0});
      believed_.x += 0.05;
      EXPECT_LT(reckoning_.observe(2, other, other.scan_at({0.065 * i, 0.0, 0.0}), believed_), 0.2) << i;
      truth_.x = believed_.x;
      reckoning_.carry({0.065, 0.0, 0.0});
      believed_.x += 0.05;
      truth_.x = believed_.x;
      EXPECT_LT(reckoning_.observe(1, model_, model_.scan_at(truth_), believed_), 0.2) << i;
    }
  }
}

TEST_F(ReckoningTest, AScannerThatFallsSilentIsReplaced) {
  drive(20, 0.1, 0.1, 0.1);
  KnowsTheWay other;
  double drift = 0.0;
  for (int i = 0; i < 200; ++i) {
    truth_.x += 0.1;
    believed_.x += 0.1;
    reckoning_.carry({0.13, 0.0, 0.0});
    drift = reckoning_.observe(2, other, other.scan_at(truth_), believed_);
  }
  EXPECT_LT(drift, 0.15);
}

}  // namespace
}  // namespace cairn
