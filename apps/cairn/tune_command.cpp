#include "apps/cairn/beam_samples.hpp"
#include "apps/cairn/commands.hpp"
#include "apps/cairn/output_file.hpp"
#include "apps/cairn/posed_scan_arguments.hpp"
#include "apps/cairn/tune_odometry.hpp"
#include "apps/cairn/tune_sensors.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/configuration.hpp"
#include "cairn/io/input_file.hpp"
#include "cairn/io/log_reader.hpp"
#include "cairn/io/map_reader.hpp"
#include "cairn/io/trajectory_reader.hpp"
#include "cairn/localization/localizer_options.hpp"

#include <fstream>
#include <iostream>
#include <memory>

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

namespace cairn::app {
namespace {

struct BeamArguments {
  std::string map, log, reference, config, spans, out;
  std::vector<std::string> settings;
  PosedScanArguments scans;
  BeamSampleOptions samples;
  int most_scans = 4000;
  BeamEmLimits em;
};

LocalizerOptions read_options(const BeamArguments& arguments) {
  LocalizerOptions options;
  Diagnostics diagnostics;
  const VisitOptions visit = [&](OptionVisitor& visitor) { options.visit(visitor); };
  if (!arguments.config.empty()) {
    read_configuration(*open_input(arguments.config), arguments.config, visit, diagnostics);
  }
  apply_settings(arguments.settings, visit);
  options.validate();
  return options;
}

PosedScans read_posed_scans(const BeamArguments& arguments, const Log& log) {
  const PosedScanOptions options = arguments.scans.options();
  const StreamId stream = laser_stream(log, options.stream);
  TrajectoryOptions trajectory;
  for (const Event& event : log.events) {
    if (event.stream == stream) trajectory.frame_stamps.push_back(event.stamp);
  }
  Diagnostics diagnostics;
  return pose_scans(log, read_trajectory(arguments.reference, trajectory, diagnostics), options);
}

BeamSamples read_samples(const BeamArguments& arguments, const LocalizerOptions& options) {
  const TimeSpans spans("--spans", arguments.spans);
  const auto map = read_map(arguments.map);
  Log log = read_log(arguments.log);
  sort_by_stamp(log);
  const std::string& stream = log.streams[laser_stream(log, arguments.scans.stream)].name;
  BeamSampleOptions samples = arguments.samples;
  samples.most_scans = static_cast<std::size_t>(arguments.most_scans);
  if (const auto found = options.streams.find(stream); found != options.streams.end())
    samples.limits = found->second.limits;
  return collect_beam_samples(read_posed_scans(arguments, log), *map, log.events.front().stamp, spans,
                              samples);
}

std::string table_of(const BeamModelOptions& start, const BeamModelOptions& learnt) {
  const auto row = [](const char* name, double from, double to) {
    return fmt::format("{:<20}{:>12.4f}{:>12.4f}\n", name, from, to);
  };
  const double weights = start.z_hit + start.z_short + start.z_max + start.z_rand;
  return fmt::format("{:<20}{:>12}{:>12}\n", "", "start", "learnt") +
         row("z_hit", start.z_hit / weights, learnt.z_hit) +
         row("z_short", start.z_short / weights, learnt.z_short) +
         row("z_max", start.z_max / weights, learnt.z_max) +
         row("z_rand", start.z_rand / weights, learnt.z_rand) +
         row("sigma_hit_m", start.sigma_hit_m, learnt.sigma_hit_m) +
         row("lambda_short_per_m", start.lambda_short_per_m, learnt.lambda_short_per_m);
}

std::string convergence_of(const BeamEmResult& result) {
  std::string text = "iteration  log-likelihood per beam, nat\n";
  for (std::size_t i = 0; i < result.steps.size(); i += i < 8 ? 1 : 8) {
    text += fmt::format("{:>9}  {:.6f}\n", i, result.steps[i].mean_log_likelihood);
  }
  return text + fmt::format("{:>9}  {:.6f} ({})\n", result.steps.size() - 1,
                            result.steps.back().mean_log_likelihood,
                            result.converged ? "converged" : "not converged: raise --iterations");
}

std::string likelihoods_of(const BeamSamples& samples, const BeamModelOptions& start,
                           const BeamModelOptions& learnt) {
  const auto row = [&](const char* name, const std::vector<BeamSample>& beams) {
    if (beams.empty()) return std::string();
    return fmt::format("{:<20}{:>12.4f}{:>12.4f}\n", name,
                       mean_log_likelihood(beams, samples.max_range_m, start),
                       mean_log_likelihood(beams, samples.max_range_m, learnt));
  };
  return row("nat/beam, learnt on", samples.learn) + row("nat/beam, held back", samples.rest);
}

std::string snippet_of(const BeamModelOptions& o, const BeamSamples& samples) {
  return fmt::format(
      "# Beam model learnt by `cairn tune beam` from {} readings of {} scans.\n"
      "laser:\n  model: beam\n  beam:\n    z_hit: {:.6g}\n    z_short: {:.6g}\n    z_max: {:.6g}\n"
      "    z_rand: {:.6g}\n    sigma_hit_m: {:.6g}\n    lambda_short_per_m: {:.6g}\n",
      samples.learn.size(), samples.scans, o.z_hit, o.z_short, o.z_max, o.z_rand, o.sigma_hit_m,
      o.lambda_short_per_m);
}

void write_snippet(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  file.close();
  if (!file) throw ConfigurationError("--out", path + " cannot be written", "choose another file");
}

int run_beam(const BeamArguments& arguments) {
  if (!arguments.out.empty()) prepare_output_file(arguments.out);
  const BeamModelOptions start = read_options(arguments).laser.beam;
  const BeamSamples samples = read_samples(arguments, read_options(arguments));
  const BeamEmResult result = learn_beam_model(samples.learn, samples.max_range_m, start, arguments.em);
  std::cout << convergence_of(result) << '\n'
            << table_of(start, result.options()) << likelihoods_of(samples, start, result.options());
  const std::string snippet = snippet_of(result.options(), samples);
  if (arguments.out.empty()) {
    std::cout << '\n' << snippet;
  } else {
    write_snippet(arguments.out, snippet);
    std::cout << "written to " << arguments.out << '\n';
  }
  if (!result.converged) spdlog::warn("not converged after {} iterations", arguments.em.max_iterations);
  return kOk;
}

void add_beam(CLI::App& parent, Runner& run) {
  auto* command = parent.add_subcommand("beam", "Parameters of the beam model, by expectation maximisation");
  auto a = std::make_shared<BeamArguments>();
  command->add_option("--map", a->map, "Map (map_server YAML, Wean)")->required();
  command->add_option("--log", a->log, "Recording with laser scans")->required();
  command
      ->add_option("--reference", a->reference,
                   "Where the robot was: a reference, or trajectory.tum of a run of localize")
      ->required();
  command->add_option("--config", a->config, "Start values, and the ranges that the stream may use");
  command->add_option("--set", a->settings, "key=value, over the configuration; may be repeated");
  add_posed_scan_options(*command, a->scans);
  command->add_option(
      "--spans", a->spans,
      "Learn from these only, seconds since the log's start: 0-300,600-900; the rest is judged");
  command->add_option("--scans", a->most_scans, "Use at most so many scans, evenly spread")
      ->check(CLI::Range(1, 10'000'000))
      ->capture_default_str();
  command->add_option("--beams", a->samples.beams_per_scan, "Use so many beams of a scan, evenly spread")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  command->add_option("--iterations", a->em.max_iterations, "At most")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  command->add_option("--out", a->out, "Configuration to write, for `cairn localize --config`");
  command->callback([a, &run] { run = [a] { return run_beam(*a); }; });
}

}  // namespace

void add_tune(CLI::App& program, Runner& run) {
  auto* command = program.add_subcommand("tune", "Learn parameters from a log and the path of its robot");
  command->require_subcommand(0, 1);
  add_beam(*command, run);
  add_tune_laser(*command, run);
  add_tune_odometry(*command, run);
  add_tune_uwb(*command, run);
}

}  // namespace cairn::app
