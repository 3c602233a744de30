#include "apps/cairn/world_file.hpp"

#include "apps/cairn/key_place.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/configuration.hpp"
#include "cairn/io/input_file.hpp"
#include "cairn/io/map_reader.hpp"
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

WorldOptions parse(const std::string& text, const std::string& name, const std::vector<std::string>& settings,
                   std::uint64_t seed) {
  WorldOptions first;
  read_over(text, name, first);
  WorldOptions options = built_in_world(first.built_in, seed);
  read_over(text, name, options);
  apply_settings(settings, [&](OptionVisitor& v) { options.visit(v); });
  return options;
}

std::vector<Wall> read_floor(const std::string& file, const fs::path& folder) {
  if (file.empty()) return {};
  Diagnostics unused;
  const AnyMap map = read_any_map(folder / file, unused);
  if (const auto* vector = std::get_if<std::shared_ptr<const VectorMap>>(&map)) return (*vector)->walls();
  return walls_of_grid(*std::get<std::shared_ptr<const OccupancyGrid>>(map));
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
  const std::vector<Wall> floor =
      read_floor(options.file, built_in ? fs::path() : fs::path(world).parent_path());
  std::optional<World> made;
  with_key_places(world, text, [&] { made.emplace(make_world(options, floor)); });
  return std::move(*made);
}

}  // namespace cairn::app
