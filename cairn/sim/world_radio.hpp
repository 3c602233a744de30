#pragma once

#include "cairn/sensing/beacon_ranges.hpp"
#include "cairn/sensing/wifi_scan.hpp"
#include "cairn/sim/radio_field.hpp"
#include "cairn/sim/sensor_view.hpp"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace cairn {

/// A transmitter of the world, with the shadowing of its signal. The field is part of the world, not of the
/// noise: it depends on `radio.pattern`, never on the seed of a recording.
struct Transmitter {
  std::string id;
  Point2 at;
  double power_dbm = 0.0;
  ShadowingField shadowing;
  WorldTransmitterOptions options = {};
};

/// @param table  "access_points" or "beacons", whose transmitters have fields of their own
std::vector<Transmitter> make_transmitters(const std::string& table,
                                           const std::vector<WorldTransmitterOptions>& options,
                                           const WorldRadioOptions& radio);

/// The access points whose level, with shadowing, noise and the receiver's offset, comes up to its
/// sensitivity and that the scan does not miss; in the order of the world's table.
WifiScan simulate_wifi(const SensorView& view, const WorldWifiOptions& options,
                       std::span<const Transmitter> access_points);

/// The beacons that are near enough and strong enough. Ranges have noise, a bias, and a delay for each wall
/// between (exponential: it only ever makes a range longer).
BeaconRanges simulate_beacons(const SensorView& view, const WorldBeaconRadioOptions& options,
                              std::span<const Transmitter> beacons);

}  // namespace cairn
