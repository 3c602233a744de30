#include "cairn/sim/world_radio.hpp"

#include "simulated_scene.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace cairn {
namespace {

constexpr int kScans = 3000;

std::vector<Transmitter> transmitters(const test::SimulatedScene& scene, const char* table,
                                      const std::vector<WorldTransmitterOptions>& all) {
  return make_transmitters(table, all, scene.options().radio);
}

test::SimulatedScene scene_without_shadowing() {
  return test::SimulatedScene([](WorldOptions& o) { o.radio.sigma_shadowing_db = 0.0; });
}

// Mean and deviation within 6 standard deviations of their estimates (alpha 2e-9 each).
TEST(WorldWifi, LevelsHaveNoiseAndTheDevicesOffset) {
  const auto scene = scene_without_shadowing();
  const auto points = transmitters(scene, "access_points", {{"a", "2,1", -40.0}});
  WorldWifiOptions o;
  o.device_offset_db = 4.0;
  o.missed_share = 0.0;
  double sum = 0.0, squares = 0.0;
  for (std::uint64_t index = 0; index < kScans; ++index) {
    const double d = *simulate_wifi(scene.view(index), o, points).rssi_dbm("a") + 40.0;
    sum += d;
    squares += (d - 4.0) * (d - 4.0);
  }
  EXPECT_NEAR(sum / kScans, 4.0, 6.0 * 2.0 / std::sqrt(kScans));
  EXPECT_NEAR(std::sqrt(squares / kScans), 2.0, 6.0 * 2.0 / std::sqrt(2.0 * kScans));
}

// The share within 6 standard deviations (alpha 2e-9).
TEST(WorldWifi, WhatIsTooWeakOrMissedIsAbsent) {
  const auto scene = scene_without_shadowing();
  const auto points = transmitters(scene, "access_points", {{"near", "2,1", -40.0}, {"weak", "2,1", -120.0}});
  WorldWifiOptions o;
  o.missed_share = 0.2;
  int heard = 0;
  for (std::uint64_t index = 0; index < kScans; ++index) {
    const WifiScan scan = simulate_wifi(scene.view(index), o, points);
    EXPECT_FALSE(scan.rssi_dbm("weak").has_value());
    heard += scan.rssi_dbm("near") ? 1 : 0;
  }
  EXPECT_NEAR(heard / static_cast<double>(kScans), 0.8, 6.0 * std::sqrt(0.2 * 0.8 / kScans));
}

TEST(WorldWifi, TheFieldIsTheWorldsNotTheSeeds) {
  WorldRadioOptions radio;
  const std::vector<WorldTransmitterOptions> all{{"a", "2,1", -40.0}};
  const double here = make_transmitters("access_points", all, radio)[0].shadowing.at({3.0, 3.0});
  EXPECT_EQ(here, make_transmitters("access_points", all, radio)[0].shadowing.at({3.0, 3.0}));
  EXPECT_NE(here, make_transmitters("beacons", all, radio)[0].shadowing.at({3.0, 3.0}));
  radio.pattern = 2;
  EXPECT_NE(here, make_transmitters("access_points", all, radio)[0].shadowing.at({3.0, 3.0}));
}

// Ranges of 3000 rounds; mean and deviation within 6 standard deviations of their estimates (alpha 2e-9
// each).
struct RangeStatistics {
  double mean = 0.0, deviation = 0.0, least = 1e9;
};

RangeStatistics range_errors(const test::SimulatedScene& scene, const WorldBeaconRadioOptions& o) {
  const auto beacons = transmitters(scene, "beacons", {{"b", "6,1", -30.0}});
  RangeStatistics statistics;
  double squares = 0.0;
  for (std::uint64_t index = 0; index < kScans; ++index) {
    const double error = simulate_beacons(scene.view(index), o, beacons).readings.at(0).range_m - 5.0;
    statistics.mean += error / kScans;
    squares += error * error / kScans;
    statistics.least = std::min(statistics.least, error);
  }
  statistics.deviation = std::sqrt(squares - statistics.mean * statistics.mean);
  return statistics;
}

TEST(WorldBeacons, RangesHaveNoiseAndBias) {
  const auto scene = scene_without_shadowing();
  WorldBeaconRadioOptions o;
  o.bias_m = 0.1;
  o.missed_share = 0.0;
  const RangeStatistics errors = range_errors(scene, o);
  EXPECT_NEAR(errors.mean, 0.1, 6.0 * 0.05 / std::sqrt(kScans));
  EXPECT_NEAR(errors.deviation, 0.05, 6.0 * 0.05 / std::sqrt(2.0 * kScans));
}

// Two walls: the delay is a sum of two exponential numbers of mean 0.3 m, whose deviation is 0.3 sqrt(2); its
// fourth moment makes the estimated deviation 2.2 times as uncertain as that of a normal number.
TEST(WorldBeacons, WallsBetweenMakeRangesLonger) {
  const test::SimulatedScene scene([](WorldOptions& o) {
    o.radio.sigma_shadowing_db = 0.0;
    o.walls.push_back({"a", "3,0.5 3,1.5", false, "opaque", true});
    o.walls.push_back({"b", "4,0.5 4,1.5", false, "opaque", true});
  });
  WorldBeaconRadioOptions o;
  o.sigma_range_m = 0.0;
  o.missed_share = 0.0;
  const RangeStatistics errors = range_errors(scene, o);
  const double sigma = 0.3 * std::sqrt(2.0);
  EXPECT_NEAR(errors.mean, 0.6, 6.0 * sigma / std::sqrt(kScans));
  EXPECT_NEAR(errors.deviation, sigma, 6.0 * 2.2 * sigma / std::sqrt(2.0 * kScans));
  EXPECT_GE(errors.least, 0.0) << "never shorter";
}

TEST(WorldBeacons, TellWhatTheRadioMeasures) {
  const auto scene = scene_without_shadowing();
  const auto beacons = transmitters(scene, "beacons", {{"b", "6,1", -30.0}, {"far", "7.9,5.9", -30.0}});
  WorldBeaconRadioOptions o;
  o.missed_share = 0.0;
  o.range_max_m = 6.0;
  o.ranges = false;
  BeaconRanges heard = simulate_beacons(scene.view(), o, beacons);
  ASSERT_EQ(heard.readings.size(), 1U) << "the other is too far";
  EXPECT_TRUE(std::isnan(heard.readings[0].range_m));
  EXPECT_NEAR(heard.readings[0].rssi_dbm, -30.0 - 22.0 * std::log10(5.0), 14.0);
  o.levels = false;
  EXPECT_TRUE(std::isnan(simulate_beacons(scene.view(), o, beacons).readings[0].rssi_dbm))
      << "connected, no more";
}

// The share within 6 standard deviations (alpha 2e-9), the mean delay likewise.
TEST(WorldBeacons, AnObstructedBeaconIsLateAndRangesAreSlant) {
  const auto scene = scene_without_shadowing();
  const auto beacons = transmitters(scene, "beacons", {{"b", "5,1", -30.0, 4.0, 0.0, 0.3, 2.0}});
  WorldBeaconRadioOptions o;
  o.missed_share = 0.0;
  o.sigma_range_m = 0.0;
  int late = 0;
  double delay = 0.0;
  for (std::uint64_t index = 0; index < kScans; ++index) {
    const double error = simulate_beacons(scene.view(index), o, beacons).readings.at(0).range_m - 5.0;
    EXPECT_GE(error, -1e-9) << "four metres away, three above";
    late += error > 1e-9 ? 1 : 0;
    delay += error;
  }
  EXPECT_NEAR(late / static_cast<double>(kScans), 0.3, 6.0 * std::sqrt(0.3 * 0.7 / kScans));
  EXPECT_NEAR(delay / late, 2.0, 6.0 * 2.0 / std::sqrt(0.3 * kScans));
}

}  // namespace
}  // namespace cairn
