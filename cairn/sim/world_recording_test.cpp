#include "cairn/sim/world_recording.hpp"

#include "small_world.hpp"

#include <sstream>
#include <string>
#include <type_traits>

#include <gtest/gtest.h>

namespace cairn {
namespace {

World busy_world() {
  WorldOptions options = test::small_world_options();
  options.people.walking = 2;
  options.lasers.emplace_back().name = "depth";
  options.lasers.back().timing.rate_hz = 5.0;
  options.lasers.back().timing.latency_s = 0.3;
  options.lasers.back().beams = 31;
  return make_world(options);
}

template <class Entry>
Entry named(const char* name) {
  Entry entry;
  entry.name = name;
  return entry;
}

World world_of_every_sensor() {
  WorldOptions o = test::small_world_options();
  o.robot.duration_s = 4.0;
  o.people.walking = 2;
  o.access_points.push_back(named<WorldTransmitterOptions>("ap"));
  o.access_points[0].at = "7,5";
  o.beacons.push_back(named<WorldTransmitterOptions>("anchor"));
  o.beacons[0].at = "1,5";
  o.landmarks.push_back(named<WorldLandmarkOptions>("mark"));
  o.landmarks[0].at = "7.9,3";
  o.sonars.push_back(named<WorldSonarOptions>("ring"));
  o.depth_cameras.push_back(named<WorldDepthCameraOptions>("depth"));
  o.depth_cameras[0].width = 64;
  o.depth_cameras[0].height = 48;
  o.wifi_radios.push_back(named<WorldWifiOptions>("wifi"));
  o.beacon_radios.push_back(named<WorldBeaconRadioOptions>("uwb"));
  o.landmark_detectors.push_back(named<WorldLandmarkDetectorOptions>("marks"));
  o.ceiling_cameras.push_back(named<WorldCeilingCameraOptions>("up"));
  o.gyroscopes.push_back(named<WorldGyroscopeOptions>("gyro"));
  return make_world(o);
}

// Everything that the events say, as text.
std::string text_of(const WorldRecording& recording) {
  std::ostringstream text;
  text.precision(17);
  const auto put_all = [&text](const auto& values) {
    for (const auto& value : values) text << +value << ' ';
  };
  for (const Event& event : recording.events) {
    text << event.stream << ' ' << event.stamp.time_since_epoch().count() << ' '
         << event.arrival.time_since_epoch().count() << ' ';
    visit_payload(event, [&](const auto& z) {
      using Z = std::decay_t<decltype(z)>;
      EXPECT_EQ(z.stamp, event.stamp);
      if constexpr (std::is_same_v<Z, Odometry>) {
        text << z.T_odom_base.x << ' ' << z.T_odom_base.y << ' ' << z.T_odom_base.theta;
      } else if constexpr (std::is_same_v<Z, LaserScan> || std::is_same_v<Z, SonarScan>) {
        put_all(z.ranges_m);
      } else if constexpr (std::is_same_v<Z, DepthImage>) {
        put_all(std::get<DepthImage::Millimetres>(z.depths));
      } else if constexpr (std::is_same_v<Z, WifiScan>) {
        for (const auto& reading : z.readings) text << reading.id << ' ' << reading.rssi_dbm << ' ';
      } else if constexpr (std::is_same_v<Z, BeaconRanges>) {
        for (const auto& r : z.readings) text << r.id << ' ' << r.range_m << ' ' << r.rssi_dbm << ' ';
      } else if constexpr (std::is_same_v<Z, LandmarkDetections>) {
        for (const auto& d : z.detections) text << d.id << ' ' << d.range_m << ' ' << d.bearing_rad << ' ';
      } else if constexpr (std::is_same_v<Z, CeilingPatch>) {
        put_all(z.gray);
      } else {
        text << z.yaw_rate_radps;
      }
    });
    text << '\n';
  }
  return text.str();
}

TEST(WorldRecording, TheSameForAnyNumberOfThreads) {
  const World world = world_of_every_sensor();
  const WorldRecording one = record_world(world, 1);
  const std::string text = text_of(one);
  EXPECT_TRUE(text == text_of(record_world(world, 1, Executor(2))));
  EXPECT_TRUE(text == text_of(record_world(world, 1, Executor(7))));
  EXPECT_FALSE(text == text_of(record_world(world, 2)));
  EXPECT_EQ(one.truth, record_world(world, 1, Executor(2)).truth);
}

TEST(WorldRecording, EverySensorHasItsStreamAndItsRate) {
  const WorldRecording recording = record_world(world_of_every_sensor(), 1);
  ASSERT_EQ(recording.streams.size(), kStreamKinds);
  std::vector<double> count(kStreamKinds, 0.0);
  for (const Event& event : recording.events) {
    EXPECT_EQ(kind_of(event), recording.streams[event.stream].kind);
    ++count[event.stream];
  }
  const double rates[] = {25.0, 10.0, 5.0, 5.0, 0.5, 4.0, 5.0, 5.0, 50.0};
  for (std::size_t i = 0; i < kStreamKinds; ++i) {
    EXPECT_EQ(static_cast<std::size_t>(recording.streams[i].kind), i);
    EXPECT_NEAR(count[i], 4.0 * rates[i] + 1.0, 1.0) << recording.streams[i].name;
  }
}

TEST(WorldRecording, StreamsComeInTheOrderOfArrival) {
  const WorldRecording recording = record_world(busy_world(), 1);
  ASSERT_EQ(recording.streams.size(), 3U);
  EXPECT_EQ(recording.streams[2].name, "depth");
  std::vector<std::size_t> count(3, 0);
  for (std::size_t i = 0; i < recording.events.size(); ++i) {
    const Event& event = recording.events[i];
    ++count[event.stream];
    if (i > 0) {
      EXPECT_LE(recording.events[i - 1].arrival, event.arrival);
    }
    if (event.stream == 2) {
      EXPECT_NEAR(to_seconds(event.arrival - event.stamp), 0.3, 1e-9);
    }
  }
  const double seconds = to_seconds(recording.truth.back().stamp);
  EXPECT_NEAR(static_cast<double>(count[0]), 25.0 * seconds, 2.0);
  EXPECT_NEAR(static_cast<double>(count[1]), 10.0 * seconds, 2.0);
  EXPECT_NEAR(static_cast<double>(count[2]), 5.0 * seconds, 2.0);
}

}  // namespace
}  // namespace cairn
