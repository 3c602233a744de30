#pragma once

#include "cairn/localization/localizer_options.hpp"
#include "cairn/localization/scheduler.hpp"
#include "cairn/localization/stream_model.hpp"
#include "cairn/maps/map_set.hpp"
#include "cairn/models/search/place_index.hpp"
#include "cairn/sensing/stream_info.hpp"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cairn {

/// What a configuration makes of each stream of a log or a robot. All rows are indexed by the stream.
struct StreamBindings {
  std::vector<std::string> names;
  std::optional<StreamId> odometry;  ///< nullopt: there is none, the robot is only seen by its sensors
  std::vector<std::unique_ptr<const StreamModel>> models;  ///< null: the stream is not bound
  std::vector<Duration> stamp_offsets;                     ///< added to the stamps of the measurements
  std::vector<Scheduler::Share> shares;
  std::vector<std::optional<Duration>> periods;  ///< where the configuration tells them
};

/// What laser scanners would see all over their map, by the name of the stream: for recipes that draw samples
/// of p(x | z). A stream without one makes it itself when it first needs it, which takes seconds.
using PlaceIndices = std::map<std::string, std::shared_ptr<const PlaceIndex>>;

/// Binds every stream to its model, mount and map.
/// @throws ConfigurationError if the options do not fit the streams or the maps
StreamBindings bind_streams(const LocalizerOptions& options, const std::vector<StreamInfo>& streams,
                            const MapLibrary& maps, const PlaceIndices& places = {});

}  // namespace cairn
