#pragma once

#include "cairn/maps/distance_field.hpp"
#include "cairn/maps/map_set.hpp"
#include "cairn/maps/ndt_map.hpp"
#include "cairn/maps/ray_marching.hpp"
#include "cairn/maps/wall_distance.hpp"
#include "cairn/maps/wall_grid.hpp"

#include <memory>

namespace cairn {

// The maps that sensor models of laser scans work on, derived from those at hand and shared between the
// models. Each throws ConfigurationError if the maps at hand do not do.

std::shared_ptr<const DistanceField> distance_field_of(const MapSet& maps, double max_distance_m);

/// Rays up to `max_range_m`, or across the whole map if that is shorter.
std::shared_ptr<const RayMarcher> ray_marcher_of(const MapSet& maps, double max_range_m);

/// The NDT map that was given, else one of the grid's walls with cells of this size.
std::shared_ptr<const NdtMap> ndt_map_of(const MapSet& maps, double cell_size_m);

/// Of the walls that a laser sees: those of the vector map that was given, else the straight walls of the
/// grid.
std::shared_ptr<const WallGrid> wall_grid_of(const MapSet& maps);
std::shared_ptr<const WallDistance> wall_distance_of(const MapSet& maps, double max_distance_m);

}  // namespace cairn
