#pragma once

#include "cairn/core/diagnostics.hpp"
#include "cairn/io/dxf.hpp"
#include "cairn/maps/map_set.hpp"
#include "cairn/maps/ndt_map.hpp"
#include "cairn/maps/occupancy_grid.hpp"
#include "cairn/maps/vector_map.hpp"

#include <filesystem>
#include <memory>
#include <variant>

namespace cairn {

/// Reads an occupancy map, told by content: a map_server YAML file (with its PNG or PGM picture beside it) or
/// a Wean map. Packed files (gzip, bzip2) are unpacked.
/// @param diagnostics  counts unknown keys
/// @throws InputError saying which file, where and what to do; for a bare picture it asks for the YAML file,
///   for a vector map it says how to make a grid of it
std::shared_ptr<const OccupancyGrid> read_map(const std::filesystem::path& path, Diagnostics& diagnostics);
std::shared_ptr<const OccupancyGrid> read_map(const std::filesystem::path& path);

using AnyMap = std::variant<std::shared_ptr<const OccupancyGrid>, std::shared_ptr<const VectorMap>,
                            std::shared_ptr<const NdtMap>>;

/// Reads an occupancy map, a vector map (`x1,y1,x2,y2` text, GeoJSON, DXF) or an NDT map: told by content.
/// @param dxf  how a drawing is read
/// @throws InputError as read_map
AnyMap read_any_map(const std::filesystem::path& path, Diagnostics& diagnostics, const DxfOptions& dxf = {});

/// The same as a set of maps for a localizer. A vector map comes with the grid that is drawn from it
/// (draw_walls, 5 cm; coarser if that would be more than 10^8 cells). A YAML file may name an NDT map and a
/// vector map of the same place in lines `ndt: FILE` and `walls: FILE`: models use them in place of what they
/// would derive from the grid.
std::shared_ptr<MapSet> read_map_set(const std::filesystem::path& path, Diagnostics& diagnostics);

/// Gives a set one more representation of the same place, in the same frame.
void add_map(const std::filesystem::path& path, MapSet& maps, Diagnostics& diagnostics);

}  // namespace cairn
