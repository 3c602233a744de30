#include "apps/cairn/log_noise.hpp"

#include "apps/cairn/output_file.hpp"
#include "apps/cairn/run_directory.hpp"
#include "apps/cairn/sensor_error_arguments.hpp"
#include "cairn/eval/metric_style.hpp"

#include <filesystem>
#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

namespace cairn::app {
namespace {

struct Arguments {
  SensorErrorArguments inputs;
  std::string out;
};

std::string table_of(const SensorErrors& errors) {
  std::string text;
  for (const auto& [name, value] : errors.metrics) {
    const MetricStyle style = style_of(name);
    text += fmt::format("{:<32}{:>12}\n", style.label, format_metric(style, value));
  }
  text += fmt::format("\n{:<32}{:>12}{:>12}{:>12}{:>12}\n", "measured - expected [m, rad]", "count", "5 %",
                      "median", "95 %");
  for (const auto& [name, sample] : errors.samples) {
    const auto q = quantiles(sample, 21);
    text += fmt::format("{:<32}{:>12}{:>12.4f}{:>12.4f}{:>12.4f}\n", name, sample.size(), q[1], q[10], q[19]);
  }
  return text;
}

std::string json_of(const SensorErrors& errors) {
  nlohmann::ordered_json json = {{"metrics", errors.metrics},
                                 {"distributions", nlohmann::ordered_json::object()}};
  for (const auto& [name, sample] : errors.samples)
    json["distributions"][name] = quantiles(sample, kNoiseQuantiles);
  return json.dump() + "\n";
}

int run_noise(const Arguments& arguments) {
  if (!arguments.out.empty()) prepare_output_folder(arguments.out);
  const SensorErrors errors = measure(arguments.inputs);
  std::cout << table_of(errors);
  if (arguments.out.empty()) return kOk;
  const auto file = std::filesystem::path(arguments.out) / kNoiseFile;
  write_file(file, json_of(errors));
  std::cout << "written to " << file.string() << "\n";
  return kOk;
}

}  // namespace

void add_log_noise(CLI::App& log, Runner& run) {
  auto* command = log.add_subcommand(
      "noise", "How laser, odometry and beacons of a recording err against a map and a reference");
  auto a = std::make_shared<Arguments>();
  add_sensor_error_options(*command, a->inputs);
  command->add_option("--out", a->out,
                      "Folder for noise.json: the figures, and quantiles of the errors (m, rad)");
  command->callback([a, &run] { run = [a] { return run_noise(*a); }; });
}

}  // namespace cairn::app
