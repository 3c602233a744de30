#include "apps/cairn/commands.hpp"
#include "apps/cairn/seed_option.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/carmen_writer.hpp"
#include "cairn/io/map_yaml.hpp"
#include "cairn/io/tum_trajectory.hpp"
#include "cairn/sim/office_recording.hpp"

#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>

#include <spdlog/fmt/fmt.h>

namespace cairn::app {
namespace {

constexpr double kLongest_s = 3600.0;

struct Arguments {
  std::string world;
  std::string out;
  std::string seed = "1";
  double duration_s = 0.0;
};

OfficeRecordingOptions check(const Arguments& arguments) {
  if (arguments.world != "office") {
    throw ConfigurationError("WORLD", "there is no world '" + arguments.world + "'",
                             "give 'office'; world files cannot be read yet");
  }
  if (!(arguments.duration_s >= 0.0 && arguments.duration_s <= kLongest_s)) {
    throw ConfigurationError("--duration", "is not between 0 and 3600 s", "give 0 for one tour");
  }
  OfficeRecordingOptions options;
  options.duration = duration_from_seconds(arguments.duration_s);
  return options;
}

std::filesystem::path beside(const std::filesystem::path& log, const char* ending) {
  return std::filesystem::path(log).replace_extension(ending);
}

int run_simulate(const Arguments& arguments) {
  const std::filesystem::path log = arguments.out;
  OfficeRecording recording = record_office(check(arguments), parse_seed("--seed", arguments.seed));
  write_carmen_log(log, {"", recording.streams, std::move(recording.events), {}});
  write_tum(beside(log, ".truth.tum"), recording.truth);
  write_map(beside(log, ".map.yaml"), recording.map);
  const Pose2& start = recording.truth.front().pose;
  std::cout << fmt::format("log       {} ({:.1f} s, {:.1f} m)\n", log.string(),
                           to_seconds(recording.truth.back().stamp), path_length(recording.truth))
            << fmt::format("truth     {}\n", beside(log, ".truth.tum").string())
            << fmt::format("map       {}\n", beside(log, ".map.yaml").string())
            << fmt::format("start     {:g},{:g},{:g}\n", start.x, start.y, start.theta);
  return kOk;
}

}  // namespace

void add_simulate(CLI::App& program, Runner& run) {
  auto* command = program.add_subcommand("simulate", "Make a log with ground truth");
  auto a = std::make_shared<Arguments>();
  command
      ->add_option("WORLD", a->world,
                   "office: a generated office; a robot with a laser drives through all its rooms")
      ->required();
  command
      ->add_option(
          "--out", a->out,
          "The log to write (CARMEN text); truth (.truth.tum) and map (.map.yaml, .map.png) go beside it")
      ->required();
  command->add_option("--seed", a->seed, "Of the office, its people and all noise")->capture_default_str();
  command->add_option("--duration", a->duration_s, "Seconds to drive (0: once through all rooms)")
      ->capture_default_str();
  command->callback([a, &run] { run = [a] { return run_simulate(*a); }; });
}

}  // namespace cairn::app
