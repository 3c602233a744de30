#pragma once

#include "cairn/core/diagnostics.hpp"
#include "cairn/maps/occupancy_grid.hpp"

#include <filesystem>
#include <memory>

namespace cairn {

/// Reads an occupancy map, told by content: a map_server YAML file (with its PNG or PGM picture beside it) or
/// a Wean map. Packed files (gzip, bzip2) are unpacked.
/// @param diagnostics  counts unknown keys
/// @throws InputError saying which file, where and what to do; for a bare picture it asks for the YAML file
std::shared_ptr<const OccupancyGrid> read_map(const std::filesystem::path& path, Diagnostics& diagnostics);
std::shared_ptr<const OccupancyGrid> read_map(const std::filesystem::path& path);

}  // namespace cairn
