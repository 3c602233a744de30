#include "cairn/models/sensor/scan_continuity.hpp"

#include "small_room.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace cairn {
namespace {

using test::at;
using test::scan_from;

const Pose2 kHere{2.0, 1.5, 0.3};
const Pose2 kTBaseSensor{0.2, -0.1, 0.5};

class ScanContinuityTest : public ::testing::Test {
 protected:
  // The scans of a robot that believes to have moved so, and did.
  std::optional<double> after(const Pose2& T_before_now) const {
    return share(kHere, kHere * T_before_now, T_before_now);
  }
  std::optional<double> share(const Pose2& before, const Pose2& now, const Pose2& T_before_now) const {
    return continuity_.share(seen(before), seen(now), T_before_now);
  }
  LaserScan seen(const Pose2& T_map_base) const {
    return scan_from(room_, T_map_base * kTBaseSensor, at(0.0), 180);
  }

  const OccupancyGrid room_ = test::small_room();
  const ScanContinuity continuity_{kTBaseSensor, {}};
};

TEST_F(ScanContinuityTest, AScanGoesOnWhereTheRobotHasMovedAsTheOdometrySays) {
  EXPECT_EQ(after({}), 1.0);
  for (const Pose2& step : {Pose2{0.1, 0, 0}, {0.3, 0.05, 0.1}, {-0.2, 0, -0.2}, {0, 0, 0.4}, {0, 0, -0.4}}) {
    ASSERT_TRUE(after(step).has_value());
    EXPECT_GT(*after(step), 0.95) << step.x << ' ' << step.theta;
  }
}

TEST_F(ScanContinuityTest, AScanFromElsewhereDoesNot) {
  for (const Pose2& there : {Pose2{6.5, 4.5, 0.3}, {2.0, 1.5, 2.0}, {2.0, 3.5, 0.3}, {6.7, 1.0, -2.0}})
    EXPECT_LT(share(kHere, there, {0.05, 0.0, 0.0}).value_or(1.0), 0.6) << there.x << ' ' << there.y;
}

TEST_F(ScanContinuityTest, ACameraIsNotAsked) {
  LaserScan scan = seen(kHere);  // all around
  EXPECT_TRUE(continuity_.can_tell(scan));
  scan.ranges_m.resize(90);
  EXPECT_TRUE(continuity_.can_tell(scan));
  scan.ranges_m.resize(30);
  EXPECT_FALSE(continuity_.can_tell(scan));
  EXPECT_FALSE(continuity_.can_tell(LaserScan{}));
}

// What a few beams saw may lie on what many did, and not the other way round.
TEST_F(ScanContinuityTest, BothScansAreAsked) {
  const Pose2 step{0.05, 0.0, 0.1};
  int differed = 0;
  for (const Pose2& there : {Pose2{6.5, 4.5, 0.3}, {2.0, 1.5, 2.0}, {2.0, 3.5, 0.3}, {6.7, 1.0, -2.0}}) {
    const auto forth = share(kHere, there, step), back = share(there, kHere, inverse(step));
    ASSERT_TRUE(forth && back);
    EXPECT_DOUBLE_EQ(*forth, *back) << there.x << ' ' << there.y;
    const ScanContinuity one_way(kTBaseSensor, {}, {.doubt = 0.0});
    differed += one_way.share(seen(kHere), seen(there), step) !=
                one_way.share(seen(there), seen(kHere), inverse(step));
  }
  EXPECT_GT(differed, 0);
}

// Widths and angles of two corridors are alike, the place between the walls is not.
TEST_F(ScanContinuityTest, AFewDecimetresAside) {
  EXPECT_LT(share(kHere, kHere * Pose2{0.0, 0.5, 0.0}, {}).value_or(1.0), 0.75);
}

TEST_F(ScanContinuityTest, BeamsOfAClockwiseScannerAreReadInTheirOrder) {
  const auto mirrored = [](LaserScan scan) {
    scan.angle_min_rad += static_cast<double>(scan.ranges_m.size() - 1) * scan.angle_increment_rad;
    scan.angle_increment_rad = -scan.angle_increment_rad;
    std::reverse(scan.ranges_m.begin(), scan.ranges_m.end());
    return scan;
  };
  const Pose2 step{0.2, 0.0, 0.2};
  EXPECT_EQ(continuity_.share(mirrored(seen(kHere)), seen(kHere * step), step), after(step));
}

// A robot that has turned sees what was behind it: that says nothing.
TEST_F(ScanContinuityTest, WhatWasOutOfViewDoesNotCount) {
  const auto half = [](LaserScan scan) {
    scan.angle_min_rad = -0.5 * kPi;
    scan.ranges_m.erase(scan.ranges_m.begin() + 136, scan.ranges_m.end());
    scan.ranges_m.erase(scan.ranges_m.begin(), scan.ranges_m.begin() + 45);
    return scan;
  };
  const Pose2 turn{0.0, 0.0, 0.45};
  EXPECT_GT(continuity_.share(half(seen(kHere)), half(seen(kHere * turn)), turn).value_or(0.0), 0.95);
}

TEST_F(ScanContinuityTest, PeopleInTheWayBreakNothing) {
  LaserScan now = seen(kHere);
  std::fill_n(now.ranges_m.begin() + 40, 30, 0.8f);
  EXPECT_GT(continuity_.share(seen(kHere), now, {}).value_or(0.0), 0.8);
}

TEST_F(ScanContinuityTest, TheMotionThatWasMadeBringsScansClosest) {
  const Pose2 motion{0.5, 0.1, 0.4};  // farther than scans are compared to tell a break
  const auto closeness = [&](const Pose2& T) {
    return continuity_.closeness(seen(kHere), seen(kHere * motion), T).value_or(-1.0);
  };
  const double made = closeness(motion);
  EXPECT_GT(made, 0.95);
  double before = made;
  for (const double off : {0.1, 0.2, 0.4}) {
    for (const double side : {-1.0, 1.0}) {
      EXPECT_LT(closeness(motion * Pose2{side * off, 0.0, 0.0}), before - 0.02) << side * off;
      EXPECT_LT(closeness(motion * Pose2{0.0, side * off, 0.0}), before - 0.02) << side * off;
    }
    before = std::max(closeness(motion * Pose2{off, 0.0, 0.0}), closeness(motion * Pose2{-off, 0.0, 0.0}));
  }
}

TEST_F(ScanContinuityTest, NoMotionIsToldWhereScansAreFarApartOrSeeNothing) {
  const LaserScan here = seen(kHere), blind;
  for (const Pose2& far : {Pose2{1.1, 0.0, 0.0}, {0.0, 0.0, 1.1}, {std::nan(""), 0.0, 0.0}})
    EXPECT_FALSE(continuity_.closeness(here, seen(kHere * Pose2{0.1, 0.0, 0.0}), far));
  EXPECT_FALSE(continuity_.closeness(blind, here, {}));
  EXPECT_FALSE(continuity_.closeness(here, blind, {}));
}

TEST_F(ScanContinuityTest, SaysNothingOfScansThatAreFarApartOrSeeNothing) {
  EXPECT_FALSE(after({0.6, 0.0, 0.0}));
  EXPECT_FALSE(after({0.0, 0.0, 0.6}));
  EXPECT_FALSE(share(kHere, kHere, {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}));
  LaserScan blind = seen(kHere);
  std::fill(blind.ranges_m.begin(), blind.ranges_m.end(), std::numeric_limits<float>::infinity());
  EXPECT_FALSE(continuity_.share(blind, seen(kHere), {}));
  EXPECT_FALSE(continuity_.share(seen(kHere), blind, {}));
  EXPECT_FALSE(continuity_.share(LaserScan{}, seen(kHere), {}));
  LaserScan still = seen(kHere);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const double increment : {0.0, kNan, 1e-300}) {
    still.angle_increment_rad = increment;
    EXPECT_FALSE(continuity_.share(still, seen(kHere), {})) << increment;
    continuity_.share(seen(kHere), still, {});
  }
  for (const double increment : {std::numeric_limits<double>::infinity(), 1e300, -1e300}) {
    still.angle_increment_rad = increment;
    EXPECT_LT(continuity_.share(still, seen(kHere), {}).value_or(0.0), 0.9) << increment;
    continuity_.share(seen(kHere), still, {});
  }
  LaserScan turned = seen(kHere);
  turned.angle_min_rad = kNan;
  EXPECT_FALSE(continuity_.share(turned, seen(kHere), {}));
  EXPECT_FALSE(continuity_.share(seen(kHere), turned, {}));
}

}  // namespace
}  // namespace cairn
