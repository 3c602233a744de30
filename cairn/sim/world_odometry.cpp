#include "cairn/sim/world_odometry.hpp"

#include "cairn/sim/simulation_random.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kSlip_s = 0.5;

// Numbers of one step of the drive, by what they decide.
enum Draw : std::uint16_t { kNoise = 0, kSlips = 1, kBumps = 2, kBumpSize = 3 };

class Wheels {
 public:
  Wheels(const WorldOdometryOptions& options, std::uint64_t seed) : options_(options), seed_(seed) {
    const auto n = simulation_random(seed, SimulationUse::kOdometryBias).normal4(0);
    left_ = 1.0 + options.sigma_wheel_radius * n[0];
    right_ = 1.0 + options.sigma_wheel_radius * n[1];
    base_ = 1.0 + options.sigma_wheel_base * n[2];
  }

  // What the wheels tell of a true motion within `dt_s`, at one step of the drive.
  Twist2 tell(const Twist2& moved, double dt_s, std::uint64_t step) {
    const RandomStream random = simulation_random(seed_, SimulationUse::kOdometryNoise, step);
    const double half_base = 0.5 * options_.wheel_base_m;
    const double left = left_ * (moved.x - half_base * moved.theta);
    const double right = right_ * (moved.x + half_base * moved.theta);
    const double way = std::hypot(moved.x, moved.y) + half_base * std::abs(moved.theta);
    const auto n = random.normal4(0, kNoise);
    const double sigma_m = options_.sigma_per_sqrt_metre_m * std::sqrt(way);
    const double ahead = 0.5 * (left + right), turn = (right - left) / (options_.wheel_base_m * base_);
    Twist2 told{options_.distance_factor * ahead + sigma_m * n[0],
                moved.y + (moved.y != 0.0 ? sigma_m * n[1] : 0.0),
                options_.turn_factor * turn + options_.drift_rad_per_m * moved.x +
                    options_.sigma_per_sqrt_metre_rad * std::sqrt(way) * n[2]};
    const double factor = slip_factor(way, dt_s, random) * (options_.reversed ? -1.0 : 1.0);
    return {factor * told.x, factor * told.y, factor * told.theta};
  }

  // The true motion that a bump in this step adds, unseen by the wheels.
  Twist2 bump(double dt_s, std::uint64_t step) const {
    const RandomStream random = simulation_random(seed_, SimulationUse::kOdometryNoise, step);
    if (options_.bump_every_s <= 0.0 || random.uniform(0, kBumps) > dt_s / options_.bump_every_s) return {};
    const auto n = random.normal4(0, kBumpSize);
    return {options_.bump_m * n[0], options_.bump_m * n[1], options_.bump_rad * n[2]};
  }

 private:
  // The true way is given, so that wheels that slip turn farther than the robot moves.
  double slip_factor(double way_m, double dt_s, const RandomStream& random) {
    if (options_.slip_every_m <= 0.0) return 1.0;
    if (slips_left_s_ <= 0.0 && random.uniform(0, kSlips) < way_m / options_.slip_every_m)
      slips_left_s_ = kSlip_s;
    if (slips_left_s_ <= 0.0) return 1.0;
    slips_left_s_ -= dt_s;
    return 1.0 / std::max(0.05, 1.0 - options_.slip_share);
  }

  WorldOdometryOptions options_;
  std::uint64_t seed_;
  double left_ = 1.0, right_ = 1.0, base_ = 1.0;
  double slips_left_s_ = 0.0;
};

}  // namespace

std::vector<Odometry> simulate_world_odometry(const RobotDrive& drive, const WorldOdometryOptions& options,
                                              std::uint64_t seed) {
  Wheels wheels(options, seed);
  std::vector<Odometry> told;
  Pose2 T_odom_base;
  for (std::size_t i = 0; i < drive.truth.size(); ++i) {
    if (i > 0 && i != drive.kidnapped_to) {
      const double dt = to_seconds(drive.truth[i].stamp - drive.truth[i - 1].stamp);
      const Twist2 moved = log(between(drive.truth[i - 1].pose, drive.truth[i].pose));
      const Twist2 push = wheels.bump(dt, i);
      T_odom_base = T_odom_base *
                    exp(wheels.tell({moved.x - push.x, moved.y - push.y, moved.theta - push.theta}, dt, i));
    }
    told.push_back({drive.truth[i].stamp, T_odom_base});
  }
  return told;
}

}  // namespace cairn
