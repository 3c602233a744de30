#include "apps/cairn/map_convert.hpp"

#include "apps/cairn/ndt_output.hpp"
#include "apps/cairn/output_file.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/geojson.hpp"
#include "cairn/io/map_reader.hpp"
#include "cairn/io/map_yaml.hpp"
#include "cairn/maps/checksum.hpp"
#include "cairn/maps/wall_drawing.hpp"
#include "cairn/maps/wall_extraction.hpp"

#include <charconv>
#include <fstream>
#include <iostream>
#include <memory>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

namespace cairn::app {
namespace {

constexpr Material kMaterials[] = {Material::kOpaque, Material::kGlass, Material::kMesh, Material::kMirror};

struct ConvertArguments {
  std::string from, to;
  std::vector<std::string> inside, layers;
  DxfOptions dxf;
  WallDrawingOptions drawing;
  WallExtractionOptions extraction;
  NdtMapOptions ndt;
};

using Grid = std::shared_ptr<const OccupancyGrid>;
using Walls = std::shared_ptr<const VectorMap>;

Point2 parse_point(const std::string& text) {
  Point2 p;
  const char* const end = text.data() + text.size();
  const auto x = std::from_chars(text.data(), end, p.x);
  const bool comma = x.ec == std::errc() && x.ptr != end && *x.ptr == ',';
  const auto y = comma ? std::from_chars(x.ptr + 1, end, p.y) : x;
  if (!comma || y.ec != std::errc() || y.ptr != end) {
    throw ConfigurationError("--inside", "'" + text + "' is no point", "give x,y in metres");
  }
  return p;
}

// LAYER=MATERIAL
void add_layer(const std::string& text, DxfOptions& dxf) {
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0) {
    throw ConfigurationError("--layer", "'" + text + "' is no assignment", "give NAME=MATERIAL");
  }
  try {
    dxf.layers[text.substr(0, equals)] = material_named(text.substr(equals + 1));
  } catch (const InputError& error) {
    throw ConfigurationError("--layer", error.what(), "");
  }
}

enum class Kind { kGrid, kWalls, kNdt };

Kind wanted_kind(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".geojson" || extension == ".json") return Kind::kWalls;
  if (extension == ".yaml" || extension == ".yml") return Kind::kGrid;
  if (extension == ".ndt") return Kind::kNdt;
  throw ConfigurationError(path.string(), "has no known extension",
                           "name it .geojson for a vector map, .yaml for a grid, .ndt for an NDT map");
}

void write_walls(const std::string& path, const VectorMap& map) {
  std::ofstream file(path, std::ios::binary);
  if (file) write_geojson(file, map);
  file.close();
  if (!file) throw InputError(path, "cannot be written", "check the folder, its permissions and space");
  spdlog::info("{}: {} walls, {:.1f} m", path, map.walls().size(), map.length_m());
}

void write_grid(const std::string& path, const OccupancyGrid& grid) {
  write_map(path, grid);
  spdlog::info("{}: {} x {} cells of {} m", path, grid.geometry().width, grid.geometry().height,
               grid.geometry().resolution_m);
  if (grid.count(CellState::kFree) == 0) {
    spdlog::warn("{}: no cell is free: the walls enclose nothing; say what is with --inside", path);
  }
}

void convert(const AnyMap& map, Kind to, const ConvertArguments& arguments) {
  const auto* grid = std::get_if<Grid>(&map);
  const auto* walls = std::get_if<Walls>(&map);
  if (grid == nullptr && walls == nullptr) {
    throw InputError(arguments.from, "is an NDT map, which cannot be converted",
                     "convert what it was made of");
  }
  if (to == Kind::kWalls) {
    write_walls(arguments.to, walls != nullptr ? **walls : extract_walls(**grid, arguments.extraction));
    return;
  }
  const Grid as_grid =
      grid != nullptr ? *grid : std::make_shared<const OccupancyGrid>(draw_walls(**walls, arguments.drawing));
  if (to == Kind::kGrid) {
    write_grid(arguments.to, *as_grid);
  } else {
    write_ndt_map(arguments.to, ndt_from_grid(*as_grid, arguments.ndt));
  }
}

int run_convert(ConvertArguments arguments) {
  const Kind to = wanted_kind(arguments.to);
  for (const std::string& point : arguments.inside) arguments.drawing.inside.push_back(parse_point(point));
  for (const std::string& layer : arguments.layers) add_layer(layer, arguments.dxf);
  prepare_output_file(arguments.to);
  Diagnostics diagnostics;
  const AnyMap map = read_any_map(arguments.from, diagnostics, arguments.dxf);
  for (const auto& [kind, count] : diagnostics.counts()) {
    spdlog::warn("{}: {} ({} times)", arguments.from, kind, count);
  }
  convert(map, to, arguments);
  return kOk;
}

}  // namespace

void add_map_convert(CLI::App& parent, Runner& run) {
  auto* command = parent.add_subcommand(
      "convert", "Grid to vector map (its straight walls), vector map to grid, or to the other format");
  auto a = std::make_shared<ConvertArguments>();
  command->add_option("FROM", a->from, "Map to read (map_server YAML, Wean, x1,y1,x2,y2 text, GeoJSON, DXF)")
      ->required();
  command
      ->add_option("TO", a->to,
                   "Map to write: NAME.geojson, NAME.yaml (its picture becomes NAME.png) or NAME.ndt")
      ->required();
  command->add_option("--resolution", a->drawing.resolution_m, "Cell size of a drawn grid, m")
      ->capture_default_str();
  command->add_option("--ndt-cell", a->ndt.cell_size_m, "Cell size of an NDT map, m")->capture_default_str();
  command->add_option("--margin", a->drawing.margin_m, "Unknown cells around the walls of a drawn grid, m")
      ->capture_default_str();
  command->add_option("--inside", a->inside,
                      "x,y (m) from where free space can be reached; may be repeated. Without: free is what "
                      "cannot be reached from outside");
  command
      ->add_option("--min-length", a->extraction.min_length_cells, "Shortest wall to find in a grid, cells")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 1e6));
  command
      ->add_option("--tolerance", a->extraction.tolerance_cells,
                   "Most that cells of a grid may lie off their wall, cells")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 100.0));
  command->add_option("--layer", a->layers,
                      "NAME=MATERIAL (opaque, glass, mesh, mirror) of a layer of a drawing; may be repeated");
  command
      ->add_option("--unit", a->dxf.unit_m,
                   "Metres per unit of a drawing, where it tells none or a wrong one")
      ->check(CLI::Range(1e-9, 1e6));
  command->callback([a, &run] { run = [a] { return run_convert(*a); }; });
}

std::string describe(const VectorMap& map, bool as_json) {
  const Bounds2& b = map.bounds();
  const std::string sum = fmt::format("{:016x}", checksum(map));
  nlohmann::ordered_json materials;
  std::string counts;
  for (const Material m : kMaterials) {
    materials[std::string(name_of(m))] = map.count(m);
    if (map.count(m) > 0)
      counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", map.count(m), name_of(m));
  }
  if (as_json) {
    const nlohmann::ordered_json json = {{"walls", map.walls().size()},
                                         {"length_m", map.length_m()},
                                         {"materials", materials},
                                         {"min", {{"x_m", b.min.x}, {"y_m", b.min.y}}},
                                         {"max", {{"x_m", b.max.x}, {"y_m", b.max.y}}},
                                         {"checksum", sum}};
    return json.dump(2) + "\n";
  }
  return fmt::format("walls     {} ({}), {:.1f} m\n", map.walls().size(), counts, map.length_m()) +
         fmt::format(
             "from      x {:.3f} m, y {:.3f} m\nto        x {:.3f} m, y {:.3f} m: {:.2f} x {:.2f} m\n",
             b.min.x, b.min.y, b.max.x, b.max.y, b.max.x - b.min.x, b.max.y - b.min.y) +
         "checksum  " + sum + "\n";
}

}  // namespace cairn::app
