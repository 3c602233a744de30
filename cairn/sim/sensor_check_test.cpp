#include "cairn/sim/sensor_check.hpp"

#include "cairn/core/errors.hpp"
#include "small_world.hpp"

#include <functional>

#include <gtest/gtest.h>

namespace cairn {
namespace {

// Key of the refusal; "accepted" if there is none.
std::string refusal(const std::function<void(WorldOptions&)>& change) {
  WorldOptions options = test::small_world_options();
  change(options);
  try {
    check_sensors(options);
  } catch (const ConfigurationError& error) {
    return error.where();
  }
  return "accepted";
}

template <class Sensor>
Sensor named(const char* name) {
  Sensor sensor;
  sensor.name = name;
  return sensor;
}

TEST(SensorCheck, TakesARobotWithEverySensorOrWithoutALaser) {
  EXPECT_EQ(refusal([](WorldOptions&) {}), "accepted");
  EXPECT_EQ(refusal([](WorldOptions& o) {
              o.lasers.clear();
              o.sonars.push_back(named<WorldSonarOptions>("ring"));
              o.depth_cameras.push_back(named<WorldDepthCameraOptions>("depth"));
              o.ceiling_cameras.push_back(named<WorldCeilingCameraOptions>("up"));
              o.gyroscopes.push_back(named<WorldGyroscopeOptions>("gyro"));
            }),
            "accepted");
}

TEST(SensorCheck, RefusesWhatDoesNotFitAndNamesTheKey) {
  EXPECT_EQ(refusal([](WorldOptions& o) { o.sonars.push_back(named<WorldSonarOptions>("front")); }),
            "sonars.front")
      << "the name of the laser";
  EXPECT_EQ(refusal([](WorldOptions& o) { o.sonars.push_back(named<WorldSonarOptions>("odom")); }),
            "sonars.odom");
  EXPECT_EQ(refusal([](WorldOptions& o) {
              o.sonars.push_back(named<WorldSonarOptions>("ring"));
              o.sonars[0].range_max_m = 0.1;
            }),
            "sonars.ring.range_max_m");
  EXPECT_EQ(refusal([](WorldOptions& o) {
              o.gyroscopes.push_back(named<WorldGyroscopeOptions>("gyro"));
              o.gyroscopes[0].mount = "1,0,0";
            }),
            "gyroscopes.gyro.mount");
  EXPECT_EQ(refusal([](WorldOptions& o) {
              o.gyroscopes.push_back(named<WorldGyroscopeOptions>("gyro"));
              o.gyroscopes[0].mount = "here";
            }),
            "gyroscopes.gyro.mount");
  EXPECT_EQ(refusal([](WorldOptions& o) {
              o.depth_cameras.push_back(named<WorldDepthCameraOptions>("depth"));
              o.depth_cameras[0].timing.rate_hz = 1000.0;
            }),
            "depth_cameras.depth.rate_hz");
  EXPECT_EQ(refusal([](WorldOptions& o) {
              o.depth_cameras.push_back(named<WorldDepthCameraOptions>("depth"));
              o.depth_cameras[0].height_m = 2.9;
            }),
            "depth_cameras.depth.height_m");
}

TEST(SensorCheck, RefusesSensorsThatHaveNothingToFind) {
  EXPECT_EQ(refusal([](WorldOptions& o) { o.wifi_radios.push_back(named<WorldWifiOptions>("w")); }),
            "wifi_radios.w");
  EXPECT_EQ(refusal([](WorldOptions& o) { o.beacon_radios.push_back(named<WorldBeaconRadioOptions>("b")); }),
            "beacon_radios.b");
  EXPECT_EQ(refusal([](WorldOptions& o) {
              o.landmark_detectors.push_back(named<WorldLandmarkDetectorOptions>("l"));
            }),
            "landmark_detectors.l");
}

TEST(SensorCheck, RefusesBurstsWithoutEnd) {
  EXPECT_EQ(refusal([](WorldOptions& o) { o.lasers[0].timing.stall_every_s = 1e-9; }),
            "lasers.front.stall_every_s");
  EXPECT_EQ(refusal([](WorldOptions& o) { o.lasers[0].timing.outage_every_s = 1e-9; }),
            "lasers.front.outage_every_s");
}

}  // namespace
}  // namespace cairn
