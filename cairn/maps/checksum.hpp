#pragma once

#include "cairn/maps/map_set.hpp"
#include "cairn/maps/ndt_map.hpp"
#include "cairn/maps/occupancy_grid.hpp"
#include "cairn/maps/vector_map.hpp"

#include <cstdint>

namespace cairn {

/// Fingerprint of a grid: equal for equal geometry (to the bit) and equal states of all cells, the same on
/// every machine (FNV-1a, 64 bits). It tells maps apart; it does not protect against forgery.
std::uint64_t checksum(const OccupancyGrid& grid);
/// Likewise of the walls, in their order.
std::uint64_t checksum(const VectorMap& map);
/// Likewise of the normal distributions.
std::uint64_t checksum(const NdtMap& map);
/// Of all that was read of a map: its grid, and walls and normal distributions if it has any (a grid alone
/// keeps its checksum).
/// @throws ConfigurationError if the set has no grid
std::uint64_t checksum(const MapSet& maps);

}  // namespace cairn
