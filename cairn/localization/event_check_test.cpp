#include "cairn/localization/event_check.hpp"

#include "every_sensor.hpp"
#include "small_room.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using ::testing::HasSubstr;
using ::testing::IsNull;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr float kNoRange = std::numeric_limits<float>::quiet_NaN();

LaserScan good_scan() { return {test::at(1.0), -1.0, 0.5, 0.1, 10.0, {1.0f, kNoRange, 2.0f}}; }

const char* defect_of(const LaserScan& scan) { return defect(test::scan_event(scan)); }

TEST(EventCheck, TakesWhatIsWhole) {
  EXPECT_THAT(defect_of(good_scan()), IsNull());
  EXPECT_THAT(defect(test::odometry_event(1.0, {1.0, -2.0, 100.0})), IsNull());
  LaserScan one_beam = good_scan();
  one_beam.ranges_m = {1.0f};
  one_beam.angle_increment_rad = 0.0;
  EXPECT_THAT(defect_of(one_beam), IsNull());
  LaserScan clockwise = good_scan();
  clockwise.angle_increment_rad = -0.5;
  EXPECT_THAT(defect_of(clockwise), IsNull());
}

TEST(EventCheck, RefusesPosesThatNoRobotHas) {
  for (const Pose2& pose : {Pose2{kNan, 0, 0}, Pose2{0, kInfinity, 0}, Pose2{0, 0, -kInfinity}}) {
    EXPECT_THAT(defect(test::odometry_event(1.0, pose)), HasSubstr("not finite"));
  }
  EXPECT_THAT(defect(test::odometry_event(1.0, {1e300, 0, 0})), HasSubstr("100000 km"));
}

TEST(EventCheck, RefusesScansWithoutMeasurement) {
  EXPECT_THAT(defect({test::at(1.0), test::at(1.0), 1, std::shared_ptr<const LaserScan>()}),
              HasSubstr("missing"));
  LaserScan scan = good_scan();
  scan.ranges_m.clear();
  EXPECT_THAT(defect_of(scan), HasSubstr("no beams"));
  scan.ranges_m = {kNoRange, 0.0f, -1.0f, -std::numeric_limits<float>::infinity()};
  EXPECT_THAT(defect_of(scan), HasSubstr("no valid range"));
  scan = good_scan();
  scan.range_max_m = kNan;
  EXPECT_THAT(defect_of(scan), HasSubstr("no valid range"));
}

TEST(EventCheck, TakesScansOfOpenPlaces) {
  for (const float no_return : {10.0f, 81.91f, std::numeric_limits<float>::infinity()}) {
    LaserScan scan = good_scan();
    scan.ranges_m = {kNoRange, no_return, 0.0f};
    EXPECT_THAT(defect_of(scan), IsNull()) << no_return;
  }
}

TEST(EventCheck, RefusesImpossibleAngles) {
  const auto with_angles = [](double min, double increment) {
    LaserScan scan = good_scan();
    scan.angle_min_rad = min;
    scan.angle_increment_rad = increment;
    return defect_of(scan);
  };
  EXPECT_THAT(with_angles(kNan, 0.1), HasSubstr("not finite"));
  EXPECT_THAT(with_angles(0.0, kInfinity), HasSubstr("not finite"));
  EXPECT_THAT(with_angles(0.0, 0.0), HasSubstr("increment of 0"));
  EXPECT_THAT(with_angles(1e308, 0.1), HasSubstr("two turns"));
  EXPECT_THAT(with_angles(0.0, 1e308), HasSubstr("two turns"));
  EXPECT_THAT(with_angles(0.0, -7.0), HasSubstr("two turns"));
}

TEST(EventCheck, TheStampsOfEventAndPayloadAgree) {
  Event event = test::odometry_event(1.0, {});
  event.stamp = test::at(2.0);
  EXPECT_THAT(defect(event), HasSubstr("not its event's"));
  event = test::scan_event(good_scan());
  event.stamp += Duration(1);
  EXPECT_THAT(defect(event), HasSubstr("not its event's"));
  event = test::scan_event(good_scan());
  event.arrival += std::chrono::hours(1);
  EXPECT_THAT(defect(event), IsNull()) << "arrival may differ";
}

TEST(EventCheck, RefusesStampsWhoseDifferencesOverflow) {
  for (const Time stamp : {Time::max(), Time::min()}) {
    const Event event{stamp, stamp, 0, Odometry{stamp, {}}};
    EXPECT_THAT(defect(event), HasSubstr("146 years"));
  }
}

TEST(EventCheck, CoversEverySensor) {
  for (const Event& event : test::every_sensor().events) {
    EXPECT_THAT(defect(event), IsNull()) << name_of(kind_of(event));
    Event late = event;
    late.stamp += Duration(1);
    EXPECT_THAT(defect(late), HasSubstr("not its event's")) << name_of(kind_of(event));
  }
  const Time t = test::at(1.0);
  EXPECT_THAT(defect({t, t, 0, std::shared_ptr<const WifiScan>()}), HasSubstr("missing"));
  EXPECT_THAT(defect({t, t, 0, std::make_shared<const CeilingPatch>(CeilingPatch{t, 1, 1, 0.0, {1}})}),
              HasSubstr("scale"));
  EXPECT_THAT(defect({t, t, 0, ImuYawRate{t, kNan}}), HasSubstr("rate"));
}

}  // namespace
}  // namespace cairn
