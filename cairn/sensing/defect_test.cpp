#include "cairn/sensing/defect.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The measurement with one thing changed makes sense or not.
template <class Measurement, class Change>
bool makes_sense(Measurement measurement, const Change& change) {
  change(measurement);
  return defect_of(measurement) == nullptr;
}

TEST(Defect, OfSonar) {
  const SonarScan good{{}, 0.1, 4.0, 0.5, {{0.2, 0.0, 0.0}, {0.0, 0.2, 1.5}}, {1.0f, 9.0f}};
  EXPECT_TRUE(makes_sense(good, [](SonarScan&) {}));
  EXPECT_FALSE(makes_sense(good, [](SonarScan& s) { s.ranges_m.pop_back(); }));
  EXPECT_FALSE(makes_sense(good, [](SonarScan& s) { s = SonarScan{}; }));
  EXPECT_FALSE(makes_sense(good, [](SonarScan& s) { s.cone_rad = 0.0; }));
  EXPECT_FALSE(makes_sense(good, [](SonarScan& s) { s.cone_rad = kNan; }));
  EXPECT_FALSE(makes_sense(good, [](SonarScan& s) { s.range_max_m = 0.1; }));
  EXPECT_FALSE(makes_sense(good, [](SonarScan& s) { s.T_sensor_transducer[0].x = kInfinity; }));
}

TEST(Defect, OfDepthImage) {
  const DepthImage good{{}, 3, 2, {2.0, 2.0, 1.0, 0.5}, 0.5, 0.0, 0.4, 6.0, DepthImage::Millimetres(6)};
  EXPECT_TRUE(makes_sense(good, [](DepthImage&) {}));
  EXPECT_TRUE(makes_sense(good, [](DepthImage& d) { d.depths = DepthImage::Metres(6); }));
  EXPECT_FALSE(makes_sense(good, [](DepthImage& d) { d.depths = DepthImage::Metres(5); }));
  EXPECT_FALSE(makes_sense(good, [](DepthImage& d) { d.width = -3; }));
  EXPECT_FALSE(makes_sense(good, [](DepthImage& d) { d.height = 1 << 30; }));
  EXPECT_FALSE(makes_sense(good, [](DepthImage& d) { d.intrinsics.fy_px = 0.0; }));
  EXPECT_FALSE(makes_sense(good, [](DepthImage& d) { d.intrinsics.cx_px = kNan; }));
  EXPECT_FALSE(makes_sense(good, [](DepthImage& d) { d.mount_pitch_rad = kNan; }));
  EXPECT_FALSE(makes_sense(good, [](DepthImage& d) { d.range_max_m = kInfinity; }));
}

TEST(Defect, OfRadio) {
  const WifiScan wifi{{}, {{"a", -50.0f}, {"b", -70.0f}}};
  EXPECT_TRUE(makes_sense(wifi, [](WifiScan&) {}));
  EXPECT_TRUE(makes_sense(wifi, [](WifiScan& w) { w.readings.clear(); })) << "nobody was heard";
  EXPECT_FALSE(makes_sense(wifi, [](WifiScan& w) { w.readings[1].id = "a"; }));
  EXPECT_FALSE(makes_sense(wifi, [](WifiScan& w) { w.readings[1].id = ""; }));
  EXPECT_FALSE(makes_sense(wifi, [](WifiScan& w) { w.readings[1].rssi_dbm = static_cast<float>(kNan); }));
  const BeaconRanges beacons{{}, {{"a", 1.0, -50.0}, {"b", kNan, kNan}}};
  EXPECT_TRUE(makes_sense(beacons, [](BeaconRanges&) {}));
  EXPECT_FALSE(makes_sense(beacons, [](BeaconRanges& b) { b.readings[0].range_m = -1.0; }));
  EXPECT_FALSE(makes_sense(beacons, [](BeaconRanges& b) { b.readings[0].range_m = kInfinity; }));
  EXPECT_FALSE(makes_sense(beacons, [](BeaconRanges& b) { b.readings[0].rssi_dbm = 1000.0; }));
  EXPECT_FALSE(makes_sense(beacons, [](BeaconRanges& b) { b.readings[0].id = "b"; }));
}

TEST(Defect, OfLandmarksCeilingAndGyroscope) {
  const LandmarkDetections marks{{}, 5.0, 1.0, {{3, 1.0, 0.2}, {LandmarkDetection::kUnknown, 2.0, 0.0}}};
  EXPECT_TRUE(makes_sense(marks, [](LandmarkDetections&) {}));
  EXPECT_FALSE(makes_sense(marks, [](LandmarkDetections& m) { m.detections[0].range_m = -1.0; }));
  EXPECT_FALSE(makes_sense(marks, [](LandmarkDetections& m) { m.detections[0].bearing_rad = kNan; }));
  EXPECT_FALSE(makes_sense(marks, [](LandmarkDetections& m) { m.field_of_view_rad = 7.0; }));
  EXPECT_FALSE(makes_sense(marks, [](LandmarkDetections& m) { m.range_max_m = 0.0; }));
  const CeilingPatch patch{{}, 2, 2, 0.01, {0, 1, 2, 3}};
  EXPECT_TRUE(makes_sense(patch, [](CeilingPatch&) {}));
  EXPECT_FALSE(makes_sense(patch, [](CeilingPatch& p) { p.gray.clear(); }));
  EXPECT_FALSE(makes_sense(patch, [](CeilingPatch& p) { p.metres_per_pixel = kInfinity; }));
  EXPECT_EQ(defect_of(ImuYawRate{{}, -3.0}), nullptr);
  EXPECT_NE(defect_of(ImuYawRate{{}, kNan}), nullptr);
  EXPECT_NE(defect_of(ImuYawRate{{}, 200.0}), nullptr);
}

}  // namespace
}  // namespace cairn
