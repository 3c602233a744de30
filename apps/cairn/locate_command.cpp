#include "apps/cairn/commands.hpp"
#include "apps/cairn/observation.hpp"
#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/beam_text.hpp"
#include "cairn/io/configuration.hpp"
#include "cairn/io/input_file.hpp"
#include "cairn/io/log_reader.hpp"
#include "cairn/io/map_reader.hpp"
#include "cairn/models/search/one_shot.hpp"

#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

namespace cairn::app {
namespace {

struct Arguments {
  std::string map;
  std::string log;
  std::string scan;
  std::string config;
  std::vector<std::string> settings;
  ObservationRequest observation;
  std::vector<double> region;
  int top = 10;
  double budget = 200.0;
  bool json = false;
};

// Odometry bends what it joins: share of the path by which the first scan is then out of place, roughly.
constexpr double kDriftShare = 0.02;

struct Timed {
  OneShotResult result;
  double prepare_s = 0.0;
  double search_s = 0.0;
};

LocalizerOptions read_options(const Arguments& arguments) {
  LocalizerOptions options;
  Diagnostics diagnostics;
  const VisitOptions visit = [&](OptionVisitor& visitor) { options.visit(visitor); };
  if (!arguments.config.empty())
    read_configuration(*open_input(arguments.config), arguments.config, visit, diagnostics);
  apply_settings(arguments.settings, visit);
  options.validate();
  return options;
}

Observation read_observation(const Arguments& arguments, const LocalizerOptions& options) {
  if (!arguments.scan.empty())
    return {Time{}, read_beams(*open_input(arguments.scan), arguments.scan), 1, 0.0};
  Log log = read_log(arguments.log);
  sort_by_stamp(log);
  return observe(log, options, arguments.observation);
}

OneShotOptions search_options(const Arguments& arguments, const LocalizerOptions& options, int scans) {
  OneShotOptions search;
  search.most_poses = arguments.top;
  search.millions_of_points = arguments.budget;
  search.effective_beams = options.laser.likelihood_field.effective_beams * scans;
  const auto& r = arguments.region;
  if (!r.empty()) search.region = MapRegion{{r[0], r[1]}, {r[2], r[3]}};
  return search;
}

Timed search(const Arguments& arguments, const LocalizerOptions& options, const OccupancyGrid& map,
             const Observation& seen) {
  using Clock = std::chrono::steady_clock;
  const auto started = Clock::now();
  LikelihoodFieldOptions model = options.laser.likelihood_field;
  model.sigma_hit_m = std::hypot(model.sigma_hit_m, kDriftShare * seen.path_m);
  const PoseSearch prepared(map, model);
  const auto ready = Clock::now();
  Timed timed{locate(prepared, seen.points, search_options(arguments, options, seen.scans))};
  timed.prepare_s = std::chrono::duration<double>(ready - started).count();
  timed.search_s = std::chrono::duration<double>(Clock::now() - ready).count();
  return timed;
}

std::string as_text(const Timed& timed, const Observation& seen) {
  std::string text = fmt::format("seen      {} end points of {} scan{}\n", seen.points.size(), seen.scans,
                                 seen.scans == 1 ? "" : "s");
  text += fmt::format("search    {:.1f} million poses in {:.2f} s (map prepared in {:.2f} s); {}\n",
                      static_cast<double>(timed.result.search.lattice_poses) / 1e6, timed.search_s,
                      timed.prepare_s,
                      timed.result.search.complete ? "proven to be the best" : "budget spent, not proven");
  text += "   weight       x m       y m   yaw deg   sigma m  sigma deg  log-likelihood\n";
  for (const LocatedPose& p : timed.result.poses) {
    text += fmt::format("{:9.4f} {:9.2f} {:9.2f} {:9.1f} {:9.2f} {:10.1f} {:15.2f}\n", p.weight,
                        p.T_map_base.x, p.T_map_base.y, radians_to_degrees(p.T_map_base.theta),
                        std::sqrt(p.covariance(0, 0) + p.covariance(1, 1)),
                        radians_to_degrees(std::sqrt(p.covariance(2, 2))), p.log_likelihood);
  }
  return text;
}

std::string as_json(const Timed& timed, const Observation& seen) {
  nlohmann::json json{{"points", seen.points.size()},
                      {"scans", seen.scans},
                      {"stamp_s", to_seconds(seen.stamp)},
                      {"complete", timed.result.search.complete},
                      {"lattice_poses", timed.result.search.lattice_poses},
                      {"evaluated_points", timed.result.search.evaluated},
                      {"prepare_s", timed.prepare_s},
                      {"search_s", timed.search_s},
                      {"poses", nlohmann::json::array()}};
  for (const LocatedPose& p : timed.result.poses) {
    nlohmann::json covariance = nlohmann::json::array();
    for (int i = 0; i < 3; ++i)
      covariance.push_back({p.covariance(i, 0), p.covariance(i, 1), p.covariance(i, 2)});
    json["poses"].push_back({{"x_m", p.T_map_base.x},
                             {"y_m", p.T_map_base.y},
                             {"yaw_rad", p.T_map_base.theta},
                             {"weight", p.weight},
                             {"log_likelihood", p.log_likelihood},
                             {"covariance", covariance}});
  }
  return json.dump(2) + "\n";
}

void check_arguments(const Arguments& a) {
  const auto refuse = [](const char* option, const char* what, const char* remedy) {
    throw ConfigurationError(option, what, remedy);
  };
  if (a.scan.empty() == a.log.empty())
    refuse("locate", "needs an observation", "give --log LOG or --scan FILE, not both");
  if (a.top < 1 || a.top > 10000) refuse("--top", "is out of range", "give 1 to 10000");
  if (!(a.budget > 0.0 && a.budget <= 1e6))
    refuse("--budget", "is out of range", "give millions of points, to 1e6");
  if (!(a.observation.path_m >= 0.0 && a.observation.path_m <= 1000.0))
    refuse("--path", "is out of range", "give 0 to 1000 m");
  if (!std::isfinite(a.observation.at_s)) refuse("--at", "is not a number", "give seconds");
  const auto& r = a.region;
  if (!r.empty() && !(r[0] < r[2] && r[1] < r[3]))
    refuse("--region", "is empty", "give x and y of the lower left and of the upper right corner");
}

int run_locate(const Arguments& arguments) {
  check_arguments(arguments);
  const LocalizerOptions options = read_options(arguments);
  Diagnostics diagnostics;
  const auto map = read_map(arguments.map, diagnostics);
  const Observation seen = read_observation(arguments, options);
  const Timed timed = search(arguments, options, *map, seen);
  std::cout << (arguments.json ? as_json(timed, seen) : as_text(timed, seen));
  if (timed.result.poses.empty()) spdlog::error("no pose found: no free cell in the region, or nothing seen");
  return timed.result.poses.empty() ? kLost : kOk;
}

}  // namespace

void add_locate(CLI::App& program, Runner& run) {
  auto* command = program.add_subcommand("locate", "Where a robot may be, from what it sees at one moment");
  auto a = std::make_shared<Arguments>();
  command->add_option("--map", a->map, "Map (map_server YAML, Wean)")->required();
  command->add_option("--log", a->log, "Recording to take the scan from");
  command->add_option("--scan", a->scan, "One scan as text: bearing (rad) and range (m) per line");
  command->add_option("--at", a->observation.at_s, "Seconds after the log's first scan")
      ->capture_default_str();
  command
      ->add_option("--path", a->observation.path_m,
                   "Join the scans of the last metres driven by odometry; 0: one scan")
      ->capture_default_str();
  command->add_option("--stream", a->observation.stream, "Laser of the log, where it has several");
  command->add_option("--config", a->config, "Configuration (YAML; see `cairn config`)");
  command->add_option("--set", a->settings, "key=value, over the configuration; may be repeated");
  command->add_option("--region", a->region, "x0 y0 x1 y1: rectangle of the map where the robot may be (m)")
      ->expected(4);
  command->add_option("--top", a->top, "Distinct poses to find")->capture_default_str();
  command->add_option("--budget", a->budget, "Most end points to look up, in millions")
      ->capture_default_str();
  command->add_flag("--json", a->json, "Print JSON (m, rad)");
  command->footer(
      "Poses are of the robot's base (--scan: of the sensor). Exit code: 0, or 4 if no pose fits.");
  command->callback([a, &run] { run = [a] { return run_locate(*a); }; });
}

}  // namespace cairn::app
