#include "cairn/maps/map_set.hpp"

#include "cairn/core/errors.hpp"

namespace cairn {

std::shared_ptr<const OccupancyGrid> MapSet::grid() const {
  auto grid = find<OccupancyGrid>();
  if (!grid) throw ConfigurationError("map", "has no occupancy grid", "give a grid map");
  return grid;
}

MapLibrary::MapLibrary(std::shared_ptr<const OccupancyGrid> grid)
    : MapLibrary(std::make_shared<const MapSet>(std::move(grid))) {}

MapLibrary::MapLibrary(const OccupancyGrid& grid) : MapLibrary(std::make_shared<const OccupancyGrid>(grid)) {}

const MapSet& MapLibrary::at(const std::string& name) const {
  const auto found = sets_.find(name);
  if (found != sets_.end()) return *found->second;
  std::string known;
  for (const auto& [each, unused] : sets_) known += (known.empty() ? "" : ", ") + ("'" + each + "'");
  throw ConfigurationError("map", "'" + name + "' is not known", "the maps of this run: " + known);
}

}  // namespace cairn
