#pragma once

#include "cairn/sensing/beacon_ranges.hpp"
#include "cairn/sensing/ceiling_patch.hpp"
#include "cairn/sensing/depth_image.hpp"
#include "cairn/sensing/imu_yaw_rate.hpp"
#include "cairn/sensing/landmark_detections.hpp"
#include "cairn/sensing/sonar_scan.hpp"
#include "cairn/sensing/wifi_scan.hpp"

namespace cairn {

/// What makes a measurement senseless whatever the map, or nullptr if it makes sense. (Readings that are
/// merely missing, and scans that saw nothing, make sense: they tell what was not there.)

/// No transducer, not one range and one finite pose for each, a cone beyond (0, pi], limits that enclose
/// nothing.
const char* defect_of(const SonarScan& scan);
/// No pixel, or not width * height of them; focal lengths that are not positive; a mount or limits that are
/// not finite.
const char* defect_of(const DepthImage& image);
/// An id that is empty or listed twice, a level that is not finite or not within [-200, 100] dBm.
const char* defect_of(const WifiScan& scan);
/// An id that is empty or listed twice, a range that is infinite or negative, a level as of WiFi. NaN is "not
/// measured".
const char* defect_of(const BeaconRanges& ranges);
/// A field of view beyond (0, 2 pi], a range that is negative or a number that is not finite.
const char* defect_of(const LandmarkDetections& detections);
/// No pixel, or not width * height of them; a scale that is not positive.
const char* defect_of(const CeilingPatch& patch);
/// A rate that is not finite or beyond 100 rad/s.
const char* defect_of(const ImuYawRate& rate);

}  // namespace cairn
