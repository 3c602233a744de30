#include "apps/cairn/commands.hpp"
#include "apps/cairn/key_place.hpp"
#include "apps/cairn/seed_option.hpp"
#include "apps/cairn/world_file.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/carmen_writer.hpp"
#include "cairn/io/configuration.hpp"
#include "cairn/io/map_yaml.hpp"
#include "cairn/io/mcap_log_writer.hpp"
#include "cairn/io/tum_trajectory.hpp"
#include "cairn/sim/world_recording.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>

#include <spdlog/fmt/fmt.h>

namespace cairn::app {
namespace {

constexpr double kLongest_s = 36000.0;

struct Arguments {
  std::string world;
  std::string out;
  std::vector<std::string> settings;
  std::string seed = "1";
  double duration_s = 0.0;
  int threads = 1;
  bool print = false;
};

void check(const Arguments& arguments) {
  if (!(arguments.duration_s >= 0.0 && arguments.duration_s <= kLongest_s)) {
    throw ConfigurationError("--duration", "is not between 0 and 36000 s",
                             "give 0 for once through the mission");
  }
  if (arguments.out.empty() && !arguments.print) {
    throw ConfigurationError("--out", "is missing", "name the log to write, or give --print");
  }
}

std::vector<std::string> settings_of(const Arguments& arguments) {
  std::vector<std::string> settings = arguments.settings;
  if (arguments.duration_s > 0.0)
    settings.push_back(fmt::format("robot.duration_s={}", arguments.duration_s));
  return settings;
}

std::filesystem::path beside(const std::filesystem::path& log, const char* ending) {
  return std::filesystem::path(log).replace_extension(ending);
}

bool is_mcap(const std::filesystem::path& log) { return log.extension() == ".mcap"; }

// Said before the robot has driven for an hour.
void check_format(const std::filesystem::path& log, const std::vector<StreamInfo>& streams) {
  if (is_mcap(log)) return;
  for (const StreamInfo& stream : streams) {
    if (stream.kind == StreamKind::kOdometry || stream.kind == StreamKind::kLaserScan) continue;
    throw ConfigurationError(
        "--out",
        fmt::format("is CARMEN text, which cannot hold '{}' ({})", stream.name, name_of(stream.kind)),
        "name a log that ends in .mcap");
  }
}

// Pictures compress well and come twice (event_writer.hpp).
mcap::Compression compression_for(const std::vector<StreamInfo>& streams) {
  const bool pictures = std::any_of(streams.begin(), streams.end(), [](const StreamInfo& stream) {
    return stream.kind == StreamKind::kDepthImage || stream.kind == StreamKind::kCeilingPatch;
  });
  return pictures ? mcap::Compression::kZstdPictures : mcap::Compression::kLz4;
}

void write_mcap(const std::filesystem::path& path, const WorldSimulation& simulation,
                const Executor& executor) {
  std::ofstream file(path, std::ios::binary);
  McapLogWriter writer(file, simulation.streams(), compression_for(simulation.streams()));
  simulation.run(executor, [&](Event&& event) {
    writer.add(event);
    if (!file)
      throw InputError(path.string(), "cannot be written", "check the folder, its permissions and space");
  });
  writer.finish();
  file.close();
  if (!file)
    throw InputError(path.string(), "cannot be written", "check the folder, its permissions and space");
}

void write_log(const std::filesystem::path& path, const WorldSimulation& simulation,
               const Executor& executor) {
  if (is_mcap(path)) return write_mcap(path, simulation, executor);
  Log log{"", simulation.streams(), {}, {}};
  simulation.run(executor, [&log](Event&& event) { log.events.push_back(std::move(event)); });
  write_carmen_log(path, log);
}

// What the mission finds wrong in the world is told with the key's place, as what its building finds.
std::unique_ptr<const WorldSimulation> drive(const Arguments& arguments, const World& world,
                                             std::uint64_t seed) {
  std::unique_ptr<const WorldSimulation> simulation;
  const std::string text = is_built_in_world(arguments.world) ? "" : read_world_text(arguments.world);
  with_key_places(arguments.world, text,
                  [&] { simulation = std::make_unique<const WorldSimulation>(world, seed); });
  return simulation;
}

int print_world(const Arguments& arguments, std::uint64_t seed) {
  WorldOptions options = read_world_options(arguments.world, settings_of(arguments), seed);
  std::cout << write_configuration([&](OptionVisitor& v) { options.visit(v); });
  return kOk;
}

int run_simulate(const Arguments& arguments) {
  check(arguments);
  const std::uint64_t seed = parse_seed("--seed", arguments.seed);
  if (arguments.print) return print_world(arguments, seed);
  const std::filesystem::path log = arguments.out;
  const World world = read_world(arguments.world, settings_of(arguments), seed);
  const Executor executor(arguments.threads);
  const auto simulation = drive(arguments, world, seed);
  check_format(log, simulation->streams());
  write_log(log, *simulation, executor);
  const Trajectory& truth = simulation->truth();
  write_tum(beside(log, ".truth.tum"), truth);
  write_map(beside(log, ".map.yaml"), world.map);
  const Pose2& start = truth.front().pose;
  std::cout << fmt::format("log       {} ({:.1f} s, {:.1f} m)\n", log.string(),
                           to_seconds(truth.back().stamp), path_length(truth))
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
                   "office, cross, hall, corridor, warehouse, or a world file (YAML; see docs/worlds.md)")
      ->required();
  command->add_option("--out", a->out,
                      "The log to write (.mcap: MCAP, else CARMEN text); truth (.truth.tum) and map "
                      "(.map.yaml, .map.png) go beside it");
  command->add_option("--set", a->settings, "key=value, over the world; may be repeated");
  command->add_option("--seed", a->seed, "Of the people, the mission and all noise; and of the office")
      ->capture_default_str();
  command->add_option("--duration", a->duration_s, "Seconds to drive (0: as the world says)")
      ->capture_default_str();
  command->add_option("--threads", a->threads, "Changes the time taken, never the results")
      ->capture_default_str();
  command->add_flag("--print", a->print, "Print the world with all its options instead");
  command->callback([a, &run] { run = [a] { return run_simulate(*a); }; });
}

}  // namespace cairn::app
