#pragma once

#include "cairn/core/diagnostics.hpp"
#include "cairn/localization/localizer_options.hpp"
#include "cairn/maps/occupancy_grid.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <string>

namespace cairn::app {

using StreamMaps = std::map<std::string, std::shared_ptr<const OccupancyGrid>>;

/// Makes the files that streams.<name>.map names absolute, so that a run can be had again from another
/// folder.
void make_stream_maps_absolute(LocalizerOptions& options);

/// Reads those files; each stands under the name that the options give it.
/// @throws InputError as read_map
StreamMaps read_stream_maps(const LocalizerOptions& options, Diagnostics& diagnostics);

/// By the same names.
std::map<std::string, std::uint64_t> checksums(const StreamMaps& maps);

}  // namespace cairn::app
