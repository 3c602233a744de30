#include "cairn/models/derived_maps.hpp"

#include "cairn/maps/wall_extraction.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace cairn {
namespace {

// The vector map that was given, or the straight walls of the grid.
std::shared_ptr<const VectorMap> vector_map_of(const MapSet& maps) {
  if (auto given = maps.find<VectorMap>()) return given;
  return maps.derive<VectorMap>(
      "grid", [&] { return std::make_shared<const VectorMap>(extract_walls(*maps.grid())); });
}

}  // namespace

std::shared_ptr<const DistanceField> distance_field_of(const MapSet& maps, double max_distance_m) {
  return maps.derive<DistanceField>(std::to_string(max_distance_m), [&] {
    return std::make_shared<const DistanceField>(*maps.grid(), max_distance_m);
  });
}

std::shared_ptr<const RayMarcher> ray_marcher_of(const MapSet& maps, double max_range_m) {
  const GridGeometry& grid = maps.grid()->geometry();
  const double longest_m = std::min(max_range_m, std::hypot(grid.width, grid.height) * grid.resolution_m);
  return maps.derive<RayMarcher>(std::to_string(longest_m),
                                 [&] { return std::make_shared<const RayMarcher>(*maps.grid(), longest_m); });
}

std::shared_ptr<const NdtMap> ndt_map_of(const MapSet& maps, double cell_size_m) {
  if (auto given = maps.find<NdtMap>()) return given;
  return maps.derive<NdtMap>(std::to_string(cell_size_m), [&] {
    return std::make_shared<const NdtMap>(ndt_from_grid(*maps.grid(), {.cell_size_m = cell_size_m}));
  });
}

std::shared_ptr<const WallGrid> wall_grid_of(const MapSet& maps) {
  return maps.derive<WallGrid>(
      "laser", [&] { return std::make_shared<const WallGrid>(vector_map_of(maps), kSeenByLaser); });
}

std::shared_ptr<const WallDistance> wall_distance_of(const MapSet& maps, double max_distance_m) {
  return maps.derive<WallDistance>(std::to_string(max_distance_m), [&] {
    return std::make_shared<const WallDistance>(vector_map_of(maps), max_distance_m, kSeenByLaser);
  });
}

}  // namespace cairn
