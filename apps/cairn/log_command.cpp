#include "apps/cairn/commands.hpp"
#include "apps/cairn/log_table.hpp"
#include "cairn/io/log_reader.hpp"
#include "cairn/io/log_summary.hpp"

#include <iostream>
#include <memory>

namespace cairn::app {
namespace {

struct Arguments {
  std::string log;
  bool json = false;
};

int run_info(const Arguments& arguments) {
  const LogSummary summary = summarize(read_log(arguments.log));
  std::cout << (arguments.json ? to_json(summary) + "\n" : log_table(summary));
  return kOk;
}

}  // namespace

void add_log(CLI::App& program, Runner& run) {
  auto* command = program.add_subcommand("log", "Look into logs");
  command->require_subcommand(0, 1);
  auto* info = command->add_subcommand("info", "What a log holds: streams, rates, gaps, anomalies");
  auto a = std::make_shared<Arguments>();
  info->add_option("LOG", a->log,
                   "CARMEN, Wean Hall or MRPT text log or ROS 1 bag; may be gzip or bzip2 packed")
      ->required();
  info->add_flag("--json", a->json, "Print JSON (s, m, rad)");
  info->callback([a, &run] { run = [a] { return run_info(*a); }; });
}

}  // namespace cairn::app
