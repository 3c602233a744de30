#include "apps/cairn/commands.hpp"
#include "cairn/core/errors.hpp"

#include <exception>
#include <string>

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace {

using namespace cairn;

int run_and_report(const app::Runner& run) {
  try {
    return run();
  } catch (const ConfigurationError& error) {
    spdlog::error("{}", error.what());
    return app::kUsage;
  } catch (const InputError& error) {
    spdlog::error("{}", error.what());
    return app::kBadInput;
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    return app::kFailed;
  }
}

}  // namespace

int main(int argc, char** argv) {
  // Results go to standard output, everything said about the work to standard error.
  spdlog::set_default_logger(spdlog::stderr_color_st("cairn"));
  spdlog::set_pattern("%^%l%$: %v");

  CLI::App program("Cairn tells a mobile robot where it is", "cairn");
  program.set_version_flag("--version", CAIRN_VERSION);
  program.failure_message([](const CLI::App*, const CLI::Error& error) {
    return std::string("error: ") + error.what() + "; see `cairn --help`\n";
  });
  program.require_subcommand(0, 1);  // none: refused below; an unknown one is named by CLI11
  cairn::app::Runner run;
  cairn::app::add_config(program, run);
  cairn::app::add_evaluate(program, run);
  cairn::app::add_kidnap(program, run);
  cairn::app::add_localize(program, run);
  cairn::app::add_locate(program, run);
  cairn::app::add_log(program, run);
  cairn::app::add_map(program, run);
  cairn::app::add_replay(program, run);
  cairn::app::add_report(program, run);
  cairn::app::add_score(program, run);
  cairn::app::add_simulate(program, run);
  cairn::app::add_tune(program, run);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? cairn::app::kOk : cairn::app::kUsage;
  }
  if (!run) {
    spdlog::error("a subcommand is missing; see `cairn --help`");
    return cairn::app::kUsage;
  }
  return run_and_report(run);
}
