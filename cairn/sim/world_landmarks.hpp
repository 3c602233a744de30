#pragma once

#include "cairn/sensing/landmark_detections.hpp"
#include "cairn/sim/sensor_view.hpp"

#include <span>
#include <vector>

namespace cairn {

struct PlacedLandmark {
  Point2 at;
  int id = 0;
};

std::vector<PlacedLandmark> make_landmarks(const std::vector<WorldLandmarkOptions>& options);

/// The landmarks in the field of view, within range and not behind anything higher than one metre (glass does
/// not hide them), with noise; some are missed, some named wrongly, and some detections are of nothing:
/// anywhere in view, with the id of any landmark.
LandmarkDetections simulate_landmarks(const SensorView& view, const WorldLandmarkDetectorOptions& options,
                                      std::span<const PlacedLandmark> landmarks);

}  // namespace cairn
