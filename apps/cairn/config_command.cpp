#include "apps/cairn/commands.hpp"
#include "cairn/io/configuration.hpp"
#include "cairn/io/input_file.hpp"
#include "cairn/localization/localizer_options.hpp"

#include <iostream>
#include <memory>

#include <spdlog/spdlog.h>

namespace cairn::app {
namespace {

struct Arguments {
  std::string recipe;
  std::string config;
  std::vector<std::string> settings;
};

int run_config(const Arguments& arguments) {
  LocalizerOptions options;
  const VisitOptions visit = [&](OptionVisitor& visitor) { options.visit(visitor); };
  Diagnostics diagnostics;
  if (!arguments.config.empty()) {
    read_configuration(*open_input(arguments.config), arguments.config, visit, diagnostics);
  }
  if (!arguments.recipe.empty()) apply_settings({"recipe=" + arguments.recipe}, visit);
  apply_settings(arguments.settings, visit);
  options.validate();
  for (const auto& [kind, text] : diagnostics.examples()) spdlog::warn("{}: {}", kind, text);
  std::cout << write_configuration(visit);
  return kOk;
}

}  // namespace

void add_config(CLI::App& program, Runner& run) {
  auto* command =
      program.add_subcommand("config", "Print the effective configuration with its documentation");
  auto a = std::make_shared<Arguments>();
  command->add_option("recipe", a->recipe,
                      "as recipe in the configuration: kld_mcl (the default), mcl, amcl, cgr, ...");
  command->add_option("--config", a->config, "Start from this file (YAML, nav2 AMCL parameters)");
  command->add_option("--set", a->settings, "key=value, over the configuration; may be repeated");
  command->callback([a, &run] { run = [a] { return run_config(*a); }; });
}

}  // namespace cairn::app
