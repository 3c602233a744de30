#pragma once

#include "cairn/core/time.hpp"

#include <limits>
#include <string>
#include <vector>

namespace cairn {

/// What was heard of one beacon. NaN stands for what this kind of radio does not measure.
struct BeaconReading {
  std::string id;
  double range_m = std::numeric_limits<double>::quiet_NaN();
  double rssi_dbm = std::numeric_limits<double>::quiet_NaN();
};

/// The radio beacons (UWB anchors, BLE tags, sensor nodes) that were heard in one round, each at most once.
/// A beacon that is listed was connected; one that is absent was not.
struct BeaconRanges {
  Time stamp;
  std::vector<BeaconReading> readings;
};

}  // namespace cairn
