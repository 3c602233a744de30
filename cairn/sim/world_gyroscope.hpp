#pragma once

#include "cairn/sensing/imu_yaw_rate.hpp"
#include "cairn/sim/sensor_view.hpp"

#include <cstddef>
#include <vector>

namespace cairn {

/// How the bias and the scale of one gyroscope are wrong, over all readings of a drive.
struct GyroscopeErrors {
  double scale = 1.0;
  std::vector<float> bias_radps;  ///< at each reading: a constant and a random walk
};

/// @param readings  that the drive is long
GyroscopeErrors draw_gyroscope_errors(const WorldGyroscopeOptions& options, std::size_t sensor,
                                      std::size_t readings, std::uint64_t seed);

/// The true rate of turn at a time of the drive; where the robot was carried away, that before it.
double true_yaw_rate(const SimulatedDrive& drive, Time time);

ImuYawRate simulate_gyroscope(const SensorView& view, const WorldGyroscopeOptions& options,
                              const GyroscopeErrors& errors);

}  // namespace cairn
