#include "cairn/sim/wheel_odometry.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/sim/simulation_random.hpp"

#include <cmath>

namespace cairn {
namespace {

struct WheelErrors {
  double left = 1.0;  // told distance / rolled distance
  double right = 1.0;
  double base = 1.0;  // assumed wheel base / true one
};

WheelErrors draw_systematic_errors(const WheelOdometryOptions& o, std::uint64_t seed) {
  const auto n = simulation_random(seed, SimulationUse::kOdometryBias).normal4(0);
  return {1.0 + o.sigma_wheel_radius * n[0], 1.0 + o.sigma_wheel_radius * n[1],
          1.0 + o.sigma_wheel_base * n[2]};
}

void check(const WheelOdometryOptions& o) {
  const bool valid = o.wheel_base_m > 0.0 && o.sigma_wheel_radius >= 0.0 && o.sigma_wheel_base >= 0.0 &&
                     o.sigma_per_sqrt_metre_m >= 0.0 && o.every >= 1;
  if (!valid)
    throw ConfigurationError("wheel odometry", "an option is out of range", "see wheel_odometry.hpp");
}

}  // namespace

std::vector<Odometry> simulate_wheel_odometry(const Trajectory& truth, const WheelOdometryOptions& options,
                                              std::uint64_t seed) {
  check(options);
  const WheelErrors errors = draw_systematic_errors(options, seed);
  const double half_base = 0.5 * options.wheel_base_m;
  std::vector<Odometry> told;
  Pose2 T_odom_base;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (i > 0) {
      const Twist2 moved = log(between(truth[i - 1].pose, truth[i].pose));
      const auto noise = simulation_random(seed, SimulationUse::kOdometryNoise, i).normal4(0);
      const auto tell = [&](double rolled, double factor, double n) {
        return factor * rolled + options.sigma_per_sqrt_metre_m * std::sqrt(std::abs(rolled)) * n;
      };
      const double left = tell(moved.x - half_base * moved.theta, errors.left, noise[0]);
      const double right = tell(moved.x + half_base * moved.theta, errors.right, noise[1]);
      const double turned = (right - left) / (options.wheel_base_m * errors.base);
      T_odom_base = T_odom_base * exp({0.5 * (left + right), 0.0, turned});
    }
    if (i % static_cast<std::size_t>(options.every) == 0) told.push_back({truth[i].stamp, T_odom_base});
  }
  return told;
}

}  // namespace cairn
