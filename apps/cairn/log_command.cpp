#include "apps/cairn/commands.hpp"
#include "apps/cairn/log_noise.hpp"
#include "apps/cairn/log_table.hpp"
#include "apps/cairn/output_file.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/log_reader.hpp"
#include "cairn/io/log_summary.hpp"
#include "cairn/io/mcap_log_writer.hpp"

#include <filesystem>
#include <iostream>
#include <memory>

namespace cairn::app {
namespace {

constexpr const char* kLogs =
    "CARMEN, Wean Hall or MRPT text log, ROS 1 bag, ROS 2 bag (.db3, .mcap) or recording of Cairn; may be "
    "gzip, "
    "bzip2 or Zstandard packed";

struct Arguments {
  std::string log;
  std::string out;
  bool json = false;
};

int run_info(const Arguments& arguments) {
  const LogSummary summary = summarize(read_log(arguments.log));
  std::cout << (arguments.json ? to_json(summary) + "\n" : log_table(summary));
  return kOk;
}

int run_convert(const Arguments& arguments) {
  if (std::filesystem::path(arguments.out).extension() != ".mcap") {
    throw ConfigurationError(arguments.out, "does not end in .mcap",
                             "MCAP is the format that can be written");
  }
  prepare_output_file(arguments.out);
  const Log log = read_log(arguments.log);
  write_mcap_log(arguments.out, log);
  std::cout << "written " << log.events.size() << " messages of " << log.streams.size() << " streams to "
            << arguments.out << "\n";
  return kOk;
}

}  // namespace

void add_log(CLI::App& program, Runner& run) {
  auto* command = program.add_subcommand("log", "Look into logs");
  command->require_subcommand(0, 1);
  auto* info = command->add_subcommand("info", "What a log holds: streams, rates, gaps, anomalies");
  auto a = std::make_shared<Arguments>();
  info->add_option("LOG", a->log, kLogs)->required();
  info->add_flag("--json", a->json, "Print JSON (s, m, rad)");
  info->callback([a, &run] { run = [a] { return run_info(*a); }; });

  auto* convert =
      command->add_subcommand("convert", "Write a log of any known format as MCAP, which ROS 2 tools open");
  convert->add_option("IN", a->log, kLogs)->required();
  convert
      ->add_option("OUT", a->out,
                   "The file to write, OUT.mcap; what Cairn reads from it is the same to the last bit")
      ->required();
  convert->callback([a, &run] { run = [a] { return run_convert(*a); }; });
  add_log_noise(*command, run);
}

}  // namespace cairn::app
