#include "cairn/sim/world_gyroscope.hpp"

#include "cairn/core/angle.hpp"

#include <cmath>

namespace cairn {

GyroscopeErrors draw_gyroscope_errors(const WorldGyroscopeOptions& o, std::size_t sensor,
                                      std::size_t readings, std::uint64_t seed) {
  const RandomStream random =
      simulation_random(seed, SimulationUse::kGyroscopeBias, step_of_stream(sensor, 0));
  const auto first = random.normal4(0, 1);
  GyroscopeErrors errors{1.0 + o.sigma_scale * first[1], {}};
  double bias = o.sigma_bias_radps * first[0];
  const double sigma_step = o.bias_walk_radps_per_sqrt_s / std::sqrt(o.timing.rate_hz);
  errors.bias_radps.reserve(readings);
  for (std::size_t i = 0; i < readings; ++i) {
    errors.bias_radps.push_back(static_cast<float>(bias));
    bias += sigma_step * random.normal4(static_cast<std::uint32_t>(i))[0];
  }
  return errors;
}

double true_yaw_rate(const SimulatedDrive& drive, Time time) {
  const Trajectory& truth = drive.truth;
  if (truth.size() < 2) return 0.0;
  const auto after = std::upper_bound(truth.begin() + 1, truth.end() - 1, time,
                                      [](Time t, const StampedPose& pose) { return t < pose.stamp; });
  auto i = static_cast<std::size_t>(after - truth.begin());  // the step from i - 1 to i
  if (i == drive.kidnapped_to && i > 1) --i;
  const double turned = normalize_angle(truth[i].pose.theta - truth[i - 1].pose.theta);
  return turned / to_seconds(truth[i].stamp - truth[i - 1].stamp);
}

ImuYawRate simulate_gyroscope(const SensorView& view, const WorldGyroscopeOptions& o,
                              const GyroscopeErrors& errors) {
  const double noise = o.sigma_radps * view.random(SimulationUse::kGyroscopeNoise).normal4(0)[0];
  const std::size_t last = errors.bias_radps.size() - 1;
  const double bias = errors.bias_radps[std::min<std::size_t>(view.index, last)];
  return {view.stamp, errors.scale * true_yaw_rate(view.drive, view.measured) + bias + noise};
}

}  // namespace cairn
