#include "cairn/sensing/defect.hpp"

#include "cairn/core/angle.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

namespace cairn {
namespace {

constexpr double kFastestTurn_radps = 100.0;
constexpr double kWeakest_dbm = -200.0, kStrongest_dbm = 100.0;

bool enclose_something(double min, double max) {
  return std::isfinite(min) && std::isfinite(max) && min >= 0.0 && max > min;
}

bool is_level(double dbm) { return dbm >= kWeakest_dbm && dbm <= kStrongest_dbm; }

// Pixels are counted in 64 bits: width * height of a damaged message overflows an int.
bool has_pixels(int width, int height, std::size_t count) {
  return width > 0 && height > 0 &&
         static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) == count;
}

template <class Readings>
const char* id_defect(const Readings& readings) {
  std::set<std::string_view> seen;
  for (const auto& reading : readings) {
    if (reading.id.empty()) return "has a reading without an id";
    if (!seen.insert(reading.id).second) return "has two readings of one id";
  }
  return nullptr;
}

}  // namespace

const char* defect_of(const SonarScan& scan) {
  if (scan.ranges_m.empty()) return "has no transducers";
  if (scan.ranges_m.size() != scan.T_sensor_transducer.size()) return "has not one range for each transducer";
  const auto finite = [](const Pose2& pose) { return is_finite(pose); };
  if (!std::all_of(scan.T_sensor_transducer.begin(), scan.T_sensor_transducer.end(), finite))
    return "has a transducer whose pose is not finite";
  if (!(scan.cone_rad > 0.0 && scan.cone_rad <= kPi)) return "has no cone between 0 and pi";
  return enclose_something(scan.range_min_m, scan.range_max_m) ? nullptr : "has limits that enclose nothing";
}

const char* defect_of(const DepthImage& image) {
  if (!has_pixels(image.width, image.height, image.pixels())) return "has not width * height pixels";
  const PinholeIntrinsics& k = image.intrinsics;
  const bool is_camera =
      k.fx_px > 0.0 && k.fy_px > 0.0 && std::isfinite(k.fx_px + k.fy_px + k.cx_px + k.cy_px);
  if (!is_camera) return "has intrinsics of no camera";
  if (!std::isfinite(image.mount_height_m + image.mount_pitch_rad)) return "has a mount that is not finite";
  return enclose_something(image.range_min_m, image.range_max_m) ? nullptr
                                                                 : "has limits that enclose nothing";
}

const char* defect_of(const WifiScan& scan) {
  const auto level = [](const AccessPointReading& reading) { return is_level(reading.rssi_dbm); };
  if (!std::all_of(scan.readings.begin(), scan.readings.end(), level)) return "has a level beyond all radios";
  return id_defect(scan.readings);
}

const char* defect_of(const BeaconRanges& ranges) {
  for (const BeaconReading& reading : ranges.readings) {
    if (reading.range_m < 0.0 || std::isinf(reading.range_m))
      return "has a range that is negative or infinite";
    if (!std::isnan(reading.rssi_dbm) && !is_level(reading.rssi_dbm)) return "has a level beyond all radios";
  }
  return id_defect(ranges.readings);
}

const char* defect_of(const LandmarkDetections& detections) {
  if (!(detections.field_of_view_rad > 0.0 && detections.field_of_view_rad <= 1.0001 * kTwoPi))
    return "has no field of view between 0 and two pi";
  if (!(detections.range_max_m > 0.0 && std::isfinite(detections.range_max_m))) return "has no largest range";
  const auto sound = [](const LandmarkDetection& d) {
    return d.range_m >= 0.0 && std::isfinite(d.range_m) && std::isfinite(d.bearing_rad);
  };
  const auto& all = detections.detections;
  return std::all_of(all.begin(), all.end(), sound) ? nullptr : "has a detection that is not finite";
}

const char* defect_of(const CeilingPatch& patch) {
  if (!has_pixels(patch.width, patch.height, patch.gray.size())) return "has not width * height pixels";
  const bool has_scale = patch.metres_per_pixel > 0.0 && std::isfinite(patch.metres_per_pixel);
  return has_scale ? nullptr : "has no positive scale";
}

const char* defect_of(const ImuYawRate& rate) {
  return std::abs(rate.yaw_rate_radps) <= kFastestTurn_radps ? nullptr : "has a rate that no robot turns at";
}

}  // namespace cairn
