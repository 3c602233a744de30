#pragma once

#include "cairn/sensing/event.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace cairn::test {

struct EverySensor {
  std::vector<StreamInfo> streams;
  std::vector<Event> events;
};

/// What a log with one stream of every kind and two messages on each holds; its numbers come back only if
/// nothing rounds.
inline EverySensor every_sensor() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const float odd_nan = std::bit_cast<float>(0x7fc12345U);
  EverySensor log;
  for (std::size_t kind = 0; kind < kStreamKinds; ++kind) {
    const auto k = static_cast<StreamKind>(kind);
    log.streams.push_back({std::string(name_of(k)), k, "", Pose2{0.1, -1.0 / 3.0, 0.2}});
  }
  for (int i = 0; i < 2; ++i) {
    const Time stamp(Duration(1'234'567'891 * std::int64_t{i} + 1));
    const double third = i + 1.0 / 3.0;
    StreamId stream = 0;
    const auto add = [&](Event::Payload payload) {
      log.events.push_back({stamp, stamp + Duration(7), stream++, std::move(payload)});
    };
    add(Odometry{stamp, {third, -third, 0.3}});
    add(std::make_shared<const LaserScan>(LaserScan{stamp, -third, 0.1, 0.05, 30.0, {1.0F, odd_nan}}));
    add(std::make_shared<const SonarScan>(
        SonarScan{stamp, 0.1, third + 4.0, 0.5, {{0.2, 0.0, 0.0}, {0.0, 0.2, third}}, {1.5F, 99.0F}}));
    DepthImage image{stamp, 3, 2, {third, 2.0, 1.0, 0.5}, 0.6, 0.1, 0.4, 6.0, {}};
    if (i == 0) image.depths = DepthImage::Millimetres{0, 1, 2, 400, 6000, 65535};
    if (i == 1) image.depths = DepthImage::Metres{0.0F, odd_nan, 0.5F, 0.1F, -0.0F, 6.0F};
    add(std::make_shared<const DepthImage>(std::move(image)));
    add(std::make_shared<const WifiScan>(WifiScan{stamp, {{"00:1a:2b", -50.25F}, {"caf\xc3\xa9", -90.0F}}}));
    add(std::make_shared<const BeaconRanges>(BeaconRanges{stamp, {{"a", third, nan}, {"b", nan, -70.0}}}));
    add(std::make_shared<const LandmarkDetections>(
        LandmarkDetections{stamp, 8.0, 2.0, {{7, third, -0.1}, {LandmarkDetection::kUnknown, 2.0, third}}}));
    add(std::make_shared<const CeilingPatch>(CeilingPatch{stamp, 2, 3, 0.01, {0, 255, 3, 4, 5, 6}}));
    add(ImuYawRate{stamp, -third});
  }
  return log;
}

}  // namespace cairn::test
