#include "apps/cairn/tune_sensors.hpp"

#include "apps/cairn/output_file.hpp"
#include "apps/cairn/run_directory.hpp"
#include "apps/cairn/sensor_error_arguments.hpp"
#include "cairn/core/errors.hpp"

#include <cmath>
#include <iostream>
#include <memory>

#include <spdlog/fmt/fmt.h>

namespace cairn::app {
namespace {

struct Arguments {
  SensorErrorArguments inputs;
  std::string name, out;
};

// Noise of a range: told by a standing robot; else by two scans, whose errors add up.
double range_sigma(const SensorErrors& errors) {
  const auto standing = errors.metrics.find("standing_sigma_m");
  if (standing != errors.metrics.end()) return standing->second;
  const auto moving = errors.metrics.find("scan_to_scan_sigma_m");
  if (moving != errors.metrics.end()) return moving->second / std::sqrt(2.0);
  throw InputError("log", "has too few scans after one another to tell the noise of a range",
                   "use a longer log");
}

double metric_or_none(const SensorErrors& errors, const char* name) {
  const auto found = errors.metrics.find(name);
  return found == errors.metrics.end() ? 0.0 : found->second;
}

std::string laser_preset(const Arguments& a, const SensorErrors& errors) {
  return fmt::format(
      "# Noise of the laser, learnt by `cairn tune laser`: of a range, from a {} robot; readings without "
      "return towards\n"
      "# walls within reach; readings that the scan before belies. What the map does not show (people, "
      "furniture) is no\n"
      "# noise of the sensor: the beam mixture of `cairn tune beam` has it.\n"
      "lasers:\n  {}:\n    sigma_range_m: {:.3g}\n    no_return_share: {:.3g}\n    random_share: {:.3g}\n",
      errors.metrics.count("standing_sigma_m") != 0 ? "standing" : "moving", a.name, range_sigma(errors),
      metric_or_none(errors, "no_return_share"), metric_or_none(errors, "scan_to_scan_far_share"));
}

std::string uwb_preset(const Arguments& a, const SensorErrors& errors) {
  if (!errors.uwb) {
    throw ConfigurationError("--world", "and the log share no beacon",
                             "name a world whose `beacons` have the ids of the log");
  }
  const LateRangeFit& fit = *errors.uwb;
  std::string text = fmt::format(
      "# Noise of the ranges, learnt by `cairn tune uwb` (EM over punctual, late and wrong ranges). What "
      "walls add is\n"
      "# within the shares of the beacons, which are of this building.\n"
      "beacon_radios:\n  {}: {{bias_m: {:.3g}, sigma_range_m: {:.3g}, nlos_mean_m: 0}}\nbeacons:\n",
      a.name, fit.bias_m, fit.sigma_m);
  for (std::size_t i = 0; i < fit.beacons.size(); ++i) {
    const LateRangeFit::Beacon& beacon = fit.beacons[i];
    text += fmt::format(
        "  \"{}\": {{wrong_share: {:.3g}, obstructed_share: {:.3g}, obstructed_mean_m: {:.3g}}}\n",
        errors.beacons[i], beacon.wrong_share, beacon.late_share, beacon.late_mean_m);
  }
  return text;
}

int run_tune(const Arguments& arguments, std::string (*preset)(const Arguments&, const SensorErrors&)) {
  if (!arguments.out.empty()) prepare_output_file(arguments.out);
  const std::string text = preset(arguments, measure(arguments.inputs));
  std::cout << text;
  if (arguments.out.empty()) return kOk;
  write_file(arguments.out, text);
  std::cout << "written to " << arguments.out << "\n";
  return kOk;
}

void add_tune_sensor(CLI::App& tune, Runner& run, const std::string& name, const char* what,
                     std::string (*preset)(const Arguments&, const SensorErrors&)) {
  auto* command = tune.add_subcommand(name, what);
  auto a = std::make_shared<Arguments>();
  a->name = name;
  add_sensor_error_options(*command, a->inputs);
  command->add_option("--name", a->name, "Name of the sensor in the world")->capture_default_str();
  command->add_option("--out", a->out, "File to write, for `presets` of a world file");
  command->callback([a, preset, &run] { run = [a, preset] { return run_tune(*a, preset); }; });
}

}  // namespace

void add_tune_laser(CLI::App& tune, Runner& run) {
  add_tune_sensor(tune, run, "laser", "Noise of a laser, for simulated worlds", laser_preset);
}

void add_tune_uwb(CLI::App& tune, Runner& run) {
  add_tune_sensor(tune, run, "uwb", "Bias, noise and late ranges of radio beacons, for simulated worlds",
                  uwb_preset);
}

}  // namespace cairn::app
