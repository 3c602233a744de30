#include "apps/cairn/world_file.hpp"

#include "apps/cairn/data_path.hpp"
#include "apps/cairn/key_place.hpp"
#include "apps/cairn/posed_scans.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/configuration.hpp"
#include "cairn/io/input_file.hpp"
#include "cairn/io/log_reader.hpp"
#include "cairn/io/map_reader.hpp"
#include "cairn/io/trajectory_reader.hpp"
#include "cairn/sim/grid_walls.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <sstream>

namespace cairn::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBuiltIn[] = {"office", "cross", "hall", "corridor", "warehouse"};

void read_over(const std::string& text, const std::string& name, WorldOptions& options) {
  std::istringstream input(text);
  Diagnostics unused;
  read_configuration(
      input, name, [&](OptionVisitor& v) { options.visit(v); }, unused);
}

fs::path beside(const fs::path& folder, const std::string& key, const std::string& file) {
  return folder / expand_data(key, file);
}

fs::path folder_of(const std::string& world) {
  return is_built_in_world(world) ? fs::path() : fs::path(world).parent_path();
}

// The built-in world, then the presets, then the file itself, then the settings.
WorldOptions parse(const std::string& text, const std::string& name, const std::vector<std::string>& settings,
                   std::uint64_t seed) {
  WorldOptions first;
  read_over(text, name, first);
  WorldOptions options = built_in_world(first.built_in, seed);
  std::istringstream presets(first.presets);
  for (std::string word; presets >> word;) {
    const std::string preset = beside(folder_of(name), "presets", word).string();
    read_over(read_world_text(preset), preset, options);
  }
  read_over(text, name, options);
  apply_settings(settings, [&](OptionVisitor& v) { options.visit(v); });
  return options;
}

Trajectory read_recorded(const WorldRobotOptions& robot, const fs::path& folder) {
  if (robot.mission != "recorded" || robot.path.empty()) return {};
  Diagnostics unused;
  TrajectoryOptions reading;
  if (!robot.path_log.empty()) {
    const Log log = read_log(beside(folder, "robot.path_log", robot.path_log));
    const StreamId laser = laser_stream(log, "");
    for (const Event& event : log.events) {
      if (event.stream == laser) reading.frame_stamps.push_back(event.stamp);
    }
  }
  return read_trajectory(beside(folder, "robot.path", robot.path), reading, unused);
}

std::vector<Wall> read_floor(const WorldOptions& options, const fs::path& folder, const Trajectory& path) {
  if (options.file.empty()) return {};
  Diagnostics unused;
  const AnyMap map = read_any_map(beside(folder, "file", options.file), unused);
  if (const auto* vector = std::get_if<std::shared_ptr<const VectorMap>>(&map)) return (*vector)->walls();
  const auto& grid = *std::get<std::shared_ptr<const OccupancyGrid>>(map);
  return walls_of_grid(cleared_along(grid, path, options.robot.clear_m));
}

}  // namespace

bool is_built_in_world(const std::string& name) {
  return std::find(std::begin(kBuiltIn), std::end(kBuiltIn), name) != std::end(kBuiltIn);
}

std::string read_world_text(const std::string& world) {
  if (!fs::exists(world)) {
    throw ConfigurationError("WORLD", "there is no world and no file '" + world + "'",
                             "give office, cross, hall, corridor, warehouse, or a world file");
  }
  const auto input = open_input(world, std::size_t{1} << 20);
  return {std::istreambuf_iterator<char>(*input), {}};
}

WorldOptions read_world_options(const std::string& world, const std::vector<std::string>& settings,
                                std::uint64_t seed) {
  const std::string text = is_built_in_world(world) ? "built_in: " + world : read_world_text(world);
  return parse(text, world, settings, seed);
}

World read_world(const std::string& world, const std::vector<std::string>& settings, std::uint64_t seed) {
  const bool built_in = is_built_in_world(world);
  const std::string text = built_in ? "built_in: " + world : read_world_text(world);
  const WorldOptions options = parse(text, world, settings, seed);
  std::optional<World> made;
  with_key_places(world, text, [&] {
    const Trajectory recorded = read_recorded(options.robot, folder_of(world));
    made.emplace(make_world(options, read_floor(options, folder_of(world), recorded), recorded));
  });
  return std::move(*made);
}

std::vector<std::string> files_of_world(const std::string& world) {
  if (is_built_in_world(world)) return {};
  WorldOptions options;
  read_over(read_world_text(world), world, options);
  std::vector<std::string> files{world};
  const auto add = [&](const std::string& key, const std::string& file) {
    const fs::path path = beside(folder_of(world), key, file);
    if (!file.empty() && fs::is_regular_file(path)) files.push_back(path.string());
  };
  add("file", options.file);
  add("robot.path", options.robot.path);
  add("robot.path_log", options.robot.path_log);
  std::istringstream presets(options.presets);
  for (std::string word; presets >> word;) add("presets", word);
  return files;
}

}  // namespace cairn::app
