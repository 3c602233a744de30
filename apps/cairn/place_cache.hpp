#pragma once

#include "apps/cairn/stream_maps.hpp"
#include "cairn/io/log.hpp"
#include "cairn/localization/stream_binding.hpp"
#include "cairn/maps/map_set.hpp"
#include "cairn/models/search/place_index.hpp"

#include <filesystem>
#include <memory>
#include <string>

namespace cairn::app {

/// Where the index of a map is kept: beside the map, told apart by everything that it depends on.
std::filesystem::path place_cache_path(const std::filesystem::path& map_path, const OccupancyGrid& map,
                                       const SignatureShape& shape, const PlaceIndexOptions& options);

/// The index of a map, from its file if that is there and whole and belongs to this map, shape and options
/// (all told by checksums); else simulated, with a progress bar, and written for the next time. A file that
/// is corrupt or of something else is warned of and replaced. Where nothing can be written, it works all the
/// same, each time anew.
std::shared_ptr<const PlaceIndex> cached_places(const std::filesystem::path& map_path,
                                                const OccupancyGrid& map, const SignatureShape& shape,
                                                const PlaceIndexOptions& options);

/// The indices that a run needs: of each laser stream in use if the recipe draws samples of p(x | z), else
/// none.
PlaceIndices places_for(const Log& log, const LocalizerOptions& options, const MapSet& maps,
                        const StreamMaps& stream_maps, const std::string& map_path);

}  // namespace cairn::app
