#include "apps/cairn/tune_odometry.hpp"

#include "apps/cairn/odometry_path.hpp"
#include "apps/cairn/output_file.hpp"
#include "apps/cairn/pose_option.hpp"
#include "apps/cairn/run_directory.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/log_reader.hpp"
#include "cairn/io/trajectory_reader.hpp"
#include "cairn/models/motion/odometry_calibration.hpp"

#include <iostream>
#include <memory>

#include <spdlog/fmt/fmt.h>

namespace cairn::app {
namespace {

struct Arguments {
  std::string log, reference, stream, out, world;
  std::string reference_mount = "0,0,0";
  MotionCutting cutting;
  double max_gap_s = 1.0;
  OdometryCalibrationOptions calibration;
};

const CLI::Range kLength(1e-3, 1e3);

// The reference as poses of the base.
Trajectory reference_of(const Arguments& arguments, const Trajectory& odometry) {
  TrajectoryOptions options;
  for (const StampedPose& told : odometry) options.frame_stamps.push_back(told.stamp);
  Diagnostics unused;
  Trajectory reference = read_trajectory(arguments.reference, options, unused);
  const Pose2 T_reference_base = inverse(parse_pose("--reference-mount", arguments.reference_mount));
  for (StampedPose& p : reference) p.pose = p.pose * T_reference_base;
  return reference;
}

std::string row(const char* name, const Estimated& e, const char* unit) {
  return fmt::format("{:<28}{:>11.6f} +- {:<10.6f}{}\n", name, e.value, e.error, unit);
}

std::string table_of(const OdometryCalibration& c) {
  return fmt::format("{} motions, {:.1f} m; values and standard errors\n\n", c.motions, c.way_m) +
         "systematic: told = factor * true\n" + row("distance_factor", c.distance_factor, "") +
         row("turn_factor", c.turn_factor, "") + row("drift_rad_per_m", c.drift_rad_per_m, "rad/m") +
         "\nrandom, growing with the way\n" +
         row("sigma_per_sqrt_metre_m", c.sigma_per_sqrt_metre_m, "m/sqrt(m)") +
         row("sigma_per_sqrt_metre_rad", c.sigma_per_sqrt_metre_rad, "rad/sqrt(m)") +
         "\nthe same for every motion (noise of the reference, jitter)\n" +
         row("sigma_constant_m", c.sigma_constant_m, "m") +
         row("sigma_constant_rad", c.sigma_constant_rad, "rad") +
         fmt::format("{:<28}{:>10.1f} %\n", "slips, bumps, jumps", 100.0 * c.outlier_share) +
         "\nfor the filter, at steps of this length\n" + row("alpha1", c.alpha1, "rad^2/rad^2") +
         row("alpha2", c.alpha2, "rad^2/m^2") + row("alpha3", c.alpha3, "m^2/m^2") +
         row("alpha4", c.alpha4, "m^2/rad^2");
}

std::string motion_snippet(const Arguments& a, const OdometryCalibration& c) {
  return fmt::format(
      "# Noise of the odometry, learnt by `cairn tune odometry` from {} motions over {:.0f} m, for updates\n"
      "# every {:g} m or {:g} rad. It is that of this robot alone: no allowance for slips or a worse floor.\n"
      "motion:\n  alpha1: {:.3g}\n  alpha2: {:.3g}\n  alpha3: {:.3g}\n  alpha4: {:.3g}\n",
      c.motions, c.way_m, a.cutting.step_m, a.cutting.step_rad, c.alpha1.value, c.alpha2.value,
      c.alpha3.value, c.alpha4.value);
}

// The robot itself: its systematic errors are those found, not drawn.
std::string world_snippet(const Arguments& a, const OdometryCalibration& c) {
  return fmt::format(
      "# Errors of the wheels, learnt by `cairn tune odometry` from {} motions over {:.0f} m.\n"
      "robot:\n  odometry:\n    wheel_base_m: {:g}\n    distance_factor: {:.4f}\n    turn_factor: {:.4f}\n"
      "    drift_rad_per_m: {:.4f}\n    sigma_wheel_radius: 0   # as this robot, for every seed\n"
      "    sigma_wheel_base: 0\n    sigma_per_sqrt_metre_m: {:.3g}\n    sigma_per_sqrt_metre_rad: {:.3g}\n",
      c.motions, c.way_m, a.calibration.wheel_base_m, c.distance_factor.value, c.turn_factor.value,
      c.drift_rad_per_m.value, c.sigma_per_sqrt_metre_m.value, c.sigma_per_sqrt_metre_rad.value);
}

void give(const std::string& path, const std::string& text) {
  if (path.empty()) {
    std::cout << '\n' << text;
    return;
  }
  write_file(path, text);
  std::cout << "written to " << path << '\n';
}

int run_odometry(Arguments arguments) {
  for (const std::string& path : {arguments.out, arguments.world}) {
    if (!path.empty()) prepare_output_file(path);
  }
  arguments.cutting.max_gap = duration_from_seconds(arguments.max_gap_s);
  const Log log = read_log(arguments.log);
  const Trajectory odometry = odometry_path(log, arguments.stream);
  const auto chains = cut_motions(odometry, reference_of(arguments, odometry), arguments.cutting);
  const OdometryCalibration found = calibrate_odometry(chains, arguments.calibration);
  std::cout << table_of(found);
  give(arguments.out, motion_snippet(arguments, found));
  give(arguments.world, world_snippet(arguments, found));
  return kOk;
}

}  // namespace

void add_tune_odometry(CLI::App& tune, Runner& run) {
  auto* command = tune.add_subcommand("odometry", "Errors of the wheels, by robust maximum likelihood");
  auto a = std::make_shared<Arguments>();
  command->add_option("--log", a->log, "Recording with odometry")->required();
  command->add_option("--reference", a->reference, "Where the robot was")->required();
  command->add_option("--stream", a->stream, "Odometry stream (default: the first)");
  command
      ->add_option("--reference-mount", a->reference_mount,
                   "x,y,yaw (m, rad) on the robot of what the reference tells the poses of")
      ->capture_default_str();
  command->add_option("--step-m", a->cutting.step_m, "A motion ends after so far, as the filter's updates")
      ->check(kLength)
      ->capture_default_str();
  command->add_option("--step-rad", a->cutting.step_rad, "or after turning so much")
      ->check(kLength)
      ->capture_default_str();
  command->add_option("--max-gap-s", a->max_gap_s, "Do not interpolate between poses further apart, s")
      ->check(CLI::Range(1e-3, 1e6))
      ->capture_default_str();
  command
      ->add_option("--wheel-base-m", a->calibration.wheel_base_m, "Distance of the wheels, where it is known")
      ->check(kLength)
      ->capture_default_str();
  command->add_option("--out", a->out, "Configuration to write, for `cairn localize --config`");
  command->add_option("--world", a->world, "Odometry to write, for a world file of `cairn simulate`");
  command->callback([a, &run] { run = [a] { return run_odometry(*a); }; });
}

}  // namespace cairn::app
