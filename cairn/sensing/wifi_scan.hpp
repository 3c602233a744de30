#pragma once

#include "cairn/core/time.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cairn {

struct AccessPointReading {
  std::string id;  ///< of the access point: its BSSID ("00:1a:2b:3c:4d:5e"), or any name
  float rssi_dbm = 0.0f;
  friend bool operator==(const AccessPointReading&, const AccessPointReading&) = default;
};

/// The access points that one WiFi scan heard, each at most once. One that is absent was not heard: it was
/// too weak, or the scan missed it; there is no reading that stands for that.
struct WifiScan {
  Time stamp;
  std::vector<AccessPointReading> readings;

  std::optional<float> rssi_dbm(std::string_view id) const {
    for (const AccessPointReading& reading : readings) {
      if (reading.id == id) return reading.rssi_dbm;
    }
    return std::nullopt;
  }
};

}  // namespace cairn
