#include "apps/cairn/commands.hpp"
#include "apps/cairn/map_building.hpp"
#include "apps/cairn/pose_option.hpp"
#include "cairn/core/angle.hpp"
#include "cairn/eval/score.hpp"
#include "cairn/io/log_reader.hpp"
#include "cairn/io/relations.hpp"
#include "cairn/io/trajectory_reader.hpp"

#include <iostream>
#include <memory>

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

namespace cairn::app {
namespace {

struct Arguments {
  std::string reference;
  std::string estimate;
  std::string align = "none";
  std::string offset = "0,0,0";
  std::string relations;
  std::string log;
  std::string stream;
  double rpe_delta_m = 1.0;
  bool json = false;
};

/// Stamps of the log's scans: what a path that numbers its poses counts.
TrajectoryOptions trajectory_options(const Arguments& arguments) {
  if (arguments.log.empty()) return {};
  const Log log = read_log(arguments.log);
  return {.frame_stamps = stamps_of(log, laser_stream(log, arguments.stream))};
}

Trajectory read_and_warn(const std::string& path, const TrajectoryOptions& options) {
  Diagnostics diagnostics;
  Trajectory trajectory = read_trajectory(path, options, diagnostics);
  for (const auto& [kind, count] : diagnostics.counts()) spdlog::warn("{}: {} ({} times)", path, kind, count);
  return trajectory;
}

std::string position_line(const Summary& s) {
  return fmt::format(
      "position  mean {:.2f} +- {:.2f} cm, rms {:.2f}, median {:.2f}, 95 % {:.2f}, max {:.2f} cm\n",
      100 * s.mean, 100 * s.standard_deviation, 100 * s.rms, 100 * s.median, 100 * s.p95, 100 * s.max);
}

std::string heading_line(const Summary& s) {
  return fmt::format("heading   mean {:.2f} deg, rms {:.2f}, max {:.2f} deg\n", radians_to_degrees(s.mean),
                     radians_to_degrees(s.rms), radians_to_degrees(s.max));
}

std::string relative_line(const Rpe& rpe) {
  if (rpe.pairs == 0) return "relative  no pair lies inside the estimate's time span\n";
  return fmt::format("relative  rms {:.2f} cm, {:.2f} deg over {} pairs ({} outside the estimate)\n",
                     100 * rpe.translation_rms_m, radians_to_degrees(rpe.rotation_rms_rad), rpe.pairs,
                     rpe.outside);
}

std::string as_text(const Score& score) {
  return fmt::format("samples   {} of {} reference poses ({:.1f} %)\n", score.ate.errors.size(),
                     score.reference_samples, 100 * score.coverage) +
         position_line(score.ate.position_m) + heading_line(score.ate.heading_rad) +
         relative_line(score.rpe) +
         fmt::format("lost      {} ({:.1f} % of the samples beyond the limits)\n",
                     score.lost.lost ? "yes" : "no", 100 * score.lost.bad_share);
}

int run_score(const Arguments& arguments) {
  ScoreOptions options;
  options.alignment = alignment_from_string(arguments.align);
  options.T_estimate_reference = parse_pose("--offset", arguments.offset);
  options.rpe_delta_m = arguments.rpe_delta_m;
  if (!arguments.relations.empty()) options.relations = read_relations(arguments.relations);
  const TrajectoryOptions reading = trajectory_options(arguments);
  const Trajectory reference = read_and_warn(arguments.reference, reading);
  const Trajectory estimate = read_and_warn(arguments.estimate, reading);
  const Score result = score(reference, estimate, options);
  std::cout << (arguments.json ? to_json(result) + "\n" : as_text(result));
  return kOk;
}

}  // namespace

void add_score(CLI::App& program, Runner& run) {
  auto* command = program.add_subcommand("score", "Accuracy of an estimated trajectory against a reference");
  auto a = std::make_shared<Arguments>();
  command->add_option("--reference", a->reference, "Trajectory taken as true (TUM, t x y theta, CSV, CARMEN)")
      ->required();
  command->add_option("--estimate", a->estimate, "Trajectory to judge, in the same clock")->required();
  command->add_option("--align", a->align, "none: same map; rigid: least squares over the whole run")
      ->capture_default_str();
  command
      ->add_option(
          "--offset", a->offset,
          "x,y,yaw (m, rad): the reference's body frame seen from the estimate's; moves every estimate")
      ->capture_default_str();
  command->add_option("--relations", a->relations,
                      "Relative poses to judge by: t1 t2 x y z roll pitch yaw per line");
  command
      ->add_option("--rpe-delta-m", a->rpe_delta_m, "Without --relations: path length to judge motion over")
      ->capture_default_str();
  command->add_option("--log", a->log, "Log whose scans stamp a path that numbers its poses (MRPT)");
  command->add_option("--stream", a->stream, "Laser stream of --log, where it has several");
  command->add_flag("--json", a->json, "Print the figures as JSON (m, rad)");
  command->callback([a, &run] { run = [a] { return run_score(*a); }; });
}

}  // namespace cairn::app
