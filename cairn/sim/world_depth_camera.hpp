#pragma once

#include "cairn/sensing/depth_image.hpp"
#include "cairn/sim/sensor_view.hpp"

namespace cairn {

/// Pinhole intrinsics of the options: square pixels, the optical axis through the middle.
PinholeIntrinsics intrinsics_of(const WorldDepthCameraOptions& options);

/// The picture of a camera of structured light, in whole millimetres: depths from casting one ray for each
/// column (depth_column.hpp), turned into disparities focal * baseline / depth, which get noise and are
/// rounded to `disparity_step_px` as the device does (Khoshelham & Oude Elberink, "Accuracy and resolution of
/// Kinect depth data", 2012: both errors of the depth grow with its square). No reading: beyond the limits,
/// where the projector's light does not come (it stands `baseline_m` to the right), and for a share of the
/// pixels.
DepthImage simulate_depth_image(const SensorView& view, const WorldDepthCameraOptions& options);

}  // namespace cairn
