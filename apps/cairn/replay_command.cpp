#include "apps/cairn/commands.hpp"
#include "apps/cairn/localize_metrics.hpp"
#include "apps/cairn/replay_run.hpp"
#include "apps/cairn/report_command.hpp"
#include "apps/cairn/run_directory.hpp"
#include "apps/cairn/what_if_table.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/configuration.hpp"
#include "cairn/io/trajectory_reader.hpp"

#include <filesystem>
#include <iostream>
#include <memory>

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

namespace cairn::app {
namespace {

struct Arguments {
  std::string run;
  std::string map;
  int threads = 1;
  std::vector<std::string> what_if;
  std::string out;
};

void warn_of_what_was_lost(const RecordedRun& run) {
  for (const auto& [kind, count] : run.recording.log.diagnostics.counts()) {
    spdlog::warn("{}: {}: {}", run.file.string(), kind, count);
  }
  const std::string& version = run.recording.header.cairn_version;
  if (version != CAIRN_VERSION) spdlog::warn("recorded with Cairn {}, this is {}", version, CAIRN_VERSION);
}

int run_replay(const Arguments& arguments, const RecordedRun& run) {
  const Recording& recording = run.recording;
  const LocalizeResult replayed = run_again(run, run.options, arguments.threads);
  const auto parting = first_parting(recording, replayed.estimates);
  if (parting) {
    const auto& [field, recorded, now] = parting->difference;
    spdlog::error("{}: estimate {} (stamp {} s) differs in {}: recorded {}, replayed {}", run.file.string(),
                  parting->number, format_time(parting->stamp), field, recorded, now);
    return kFailed;
  }
  std::cout << fmt::format("replayed  {} events, {} estimates: the same to the last bit\n",
                           recording.log.events.size(), recording.estimates.size());
  if (!recording.finished) std::cout << "note      the recorded run did not come to its end\n";
  return kOk;
}

std::optional<Trajectory> reference_of(const RecordedRun& run) {
  const std::filesystem::path path = run.file.parent_path() / "reference.tum";
  if (!std::filesystem::exists(path)) return std::nullopt;
  Diagnostics diagnostics;
  return read_trajectory(path, {}, diagnostics);
}

// A run like any other, whose reference is the recorded run: its report shows both trajectories.
void write_comparison(const Arguments& arguments, const RecordedRun& run, const LocalizerOptions& options,
                      const LocalizeResult& result) {
  RunData data;
  data.reference = trajectory_of(run.recording.estimates);
  const RunHeader& header = run.recording.header;
  const RunContext context{header.log_path, header.map_path, header.seed, arguments.threads, 0.0,
                           header.live};
  data.metrics =
      summarize_run(context, run.recording.log, *run.map, options, data.reference, Diagnostics(), result)
          .metrics;
  data.metrics["reference"] = "the recorded run " + run.file.string();
  data.trajectory = trajectory_of(result.estimates);
  data.estimates = result.estimates;
  data.configuration = write_configuration([copy = options](OptionVisitor& v) mutable { copy.visit(v); });
  data.map = run.map;
  data.particles = result.snapshots;
  write_run(arguments.out, data);
  const std::string no_report = write_report(arguments.out);
  if (!no_report.empty()) spdlog::warn("no report.html: {}", no_report);
  std::cout << "written to " << arguments.out << " (its reference is the recorded run)\n";
}

int run_what_if(const Arguments& arguments, const RecordedRun& run) {
  LocalizerOptions options = run.options;
  apply_settings(arguments.what_if, [&](OptionVisitor& visitor) { options.visit(visitor); });
  options.validate();
  const LocalizeResult result = run_again(run, options, arguments.threads);
  std::cout << what_if_table(run.recording.estimates, result.estimates, reference_of(run));
  if (!arguments.out.empty()) write_comparison(arguments, run, options, result);
  return kOk;
}

int run_command(const Arguments& arguments) {
  if (arguments.threads < 1 || arguments.threads > Executor::kMostThreads) {
    throw ConfigurationError("--threads", "is " + std::to_string(arguments.threads),
                             "use 1 to " + std::to_string(Executor::kMostThreads));
  }
  if (!arguments.out.empty()) check_run_directory(arguments.out);
  const RecordedRun run = read_recorded_run(arguments.run, arguments.map);
  warn_of_what_was_lost(run);
  return arguments.what_if.empty() ? run_replay(arguments, run) : run_what_if(arguments, run);
}

}  // namespace

void add_replay(CLI::App& program, Runner& run) {
  auto* command =
      program.add_subcommand("replay", "Run a recorded run again, bit for bit, or with other parameters");
  auto a = std::make_shared<Arguments>();
  command->add_option("DIR", a->run, "Folder of a `cairn localize` run, or its run.mcap")->required();
  command->add_option("--map", a->map, "The run's map, if it is no longer where it was");
  command->add_option("--threads", a->threads, "Changes the time taken, never the results")
      ->capture_default_str();
  auto* what_if = command->add_option(
      "--what-if", a->what_if, "key=value ...: run with these parameters instead, and compare the two runs");
  command
      ->add_option("--out", a->out,
                   "Folder for the run with --what-if; its report compares it with the recorded one")
      ->needs(what_if);
  command->footer(
      "Exit code: 0 every estimate is the same to the last bit (with --what-if: the other run was made), 1 "
      "one "
      "differs (the first is named), 2 usage or configuration, 3 no recording, or another map.");
  command->callback([a, &run] { run = [a] { return run_command(*a); }; });
}

}  // namespace cairn::app
