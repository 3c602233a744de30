#include "cairn/io/map_reader.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/dxf.hpp"
#include "cairn/io/geojson.hpp"
#include "cairn/io/gray_image.hpp"
#include "cairn/io/input_file.hpp"
#include "cairn/io/map_yaml.hpp"
#include "cairn/io/ndt_file.hpp"
#include "cairn/io/vector_text.hpp"
#include "cairn/io/wean_map.hpp"
#include "cairn/maps/wall_drawing.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr std::size_t kFirstBytes = 1024;
constexpr std::size_t kMaxYamlBytes = 1 << 20;

std::string first_bytes(std::istream& input) {
  std::string bytes(kFirstBytes, '\0');
  input.read(bytes.data(), kFirstBytes);
  bytes.resize(static_cast<std::size_t>(input.gcount()));
  input.clear();
  input.seekg(0);
  return bytes;
}

std::size_t size_of(std::istream& input) {
  input.seekg(0, std::ios::end);
  const auto size = static_cast<std::size_t>(input.tellg());
  input.seekg(0);
  return size;
}

/// A map, and what its YAML file says of it.
struct DescribedMap {
  AnyMap map;
  MapDescription description = {};
};

DescribedMap read_yaml_map(std::istream& input, const std::filesystem::path& path, Diagnostics& diagnostics) {
  if (size_of(input) > kMaxYamlBytes) {
    throw InputError(path.string(), "is no known map format", "name the map's .yaml file");
  }
  const MapDescription map = read_map_description(input, path.string(), diagnostics);
  const std::filesystem::path picture =
      path.parent_path() / map.image;  // an absolute image path stays as it is
  return {
      std::make_shared<const OccupancyGrid>(to_grid(read_image(*open_input(picture), picture.string()), map)),
      map};
}

constexpr double kDrawnResolution_m = 0.05;
constexpr double kMostDrawnCells = 1e8;

std::shared_ptr<const VectorMap> share(VectorMap map) {
  return std::make_shared<const VectorMap>(std::move(map));
}
std::shared_ptr<const OccupancyGrid> share(OccupancyGrid grid) {
  return std::make_shared<const OccupancyGrid>(std::move(grid));
}

std::shared_ptr<const OccupancyGrid> draw(const VectorMap& map) {
  const Bounds2& b = map.bounds();
  const double area = (b.max.x - b.min.x + 1.0) * (b.max.y - b.min.y + 1.0);
  return share(
      draw_walls(map, {.resolution_m = std::max(kDrawnResolution_m, std::sqrt(area / kMostDrawnCells))}));
}

DescribedMap read_described(const std::filesystem::path& path, Diagnostics& diagnostics,
                            const DxfOptions& dxf) {
  const auto input = open_input(path);
  const std::string start = first_bytes(*input);
  if (looks_like_image(start)) {
    throw InputError(path.string(), "is a bare picture without scale and place", "name the map's .yaml file");
  }
  if (looks_like_wean_map(start)) return {share(read_wean_map(*input, path.string()))};
  if (looks_like_ndt(start)) return {read_ndt(*input, path.string())};
  if (looks_like_geojson(start)) return {share(read_geojson(*input, path.string(), diagnostics))};
  if (looks_like_dxf(start)) return {share(read_dxf(*input, path.string(), dxf, diagnostics))};
  if (looks_like_vector_text(start)) return {share(read_vector_text(*input, path.string(), diagnostics))};
  return read_yaml_map(*input, path, diagnostics);
}

/// Adds what a YAML file names beside its picture.
template <class Map>
void add_named(const std::string& name, const char* kind, const std::filesystem::path& yaml, MapSet& maps,
               Diagnostics& diagnostics) {
  if (name.empty()) return;
  const std::filesystem::path path = yaml.parent_path() / name;
  const AnyMap map = read_described(path, diagnostics, {}).map;
  const auto* wanted = std::get_if<std::shared_ptr<const Map>>(&map);
  if (wanted == nullptr)
    throw InputError(yaml.string(), "names " + name + " as its " + kind + " map, which it is not",
                     "name a file of that kind, or leave the line out");
  maps.add(*wanted);
}

}  // namespace

AnyMap read_any_map(const std::filesystem::path& path, Diagnostics& diagnostics, const DxfOptions& dxf) {
  return read_described(path, diagnostics, dxf).map;
}

std::shared_ptr<const OccupancyGrid> read_map(const std::filesystem::path& path, Diagnostics& diagnostics) {
  const AnyMap map = read_any_map(path, diagnostics);
  if (const auto* grid = std::get_if<std::shared_ptr<const OccupancyGrid>>(&map)) return *grid;
  if (std::holds_alternative<std::shared_ptr<const NdtMap>>(map)) {
    throw InputError(path.string(), "is an NDT map; a grid is needed here", "name the grid beside it");
  }
  throw InputError(path.string(), "is a vector map; a grid is needed here",
                   "make one with `cairn map convert`");
}

std::shared_ptr<const OccupancyGrid> read_map(const std::filesystem::path& path) {
  Diagnostics diagnostics;
  return read_map(path, diagnostics);
}

std::shared_ptr<MapSet> read_map_set(const std::filesystem::path& path, Diagnostics& diagnostics) {
  auto maps = std::make_shared<MapSet>();
  add_map(path, *maps, diagnostics);
  return maps;
}

void add_map(const std::filesystem::path& path, MapSet& maps, Diagnostics& diagnostics) {
  const DescribedMap read = read_described(path, diagnostics, {});
  std::visit([&](const auto& map) { maps.add(map); }, read.map);
  add_named<NdtMap>(read.description.ndt, "NDT", path, maps, diagnostics);
  add_named<VectorMap>(read.description.walls, "vector", path, maps, diagnostics);
  const auto walls = maps.find<VectorMap>();
  if (walls && !maps.find<OccupancyGrid>()) maps.add(draw(*walls));
}

}  // namespace cairn
