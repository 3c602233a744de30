#pragma once

#include "cairn/localization/fusion_localizer.hpp"
#include "cairn/localization/localizer_options.hpp"
#include "cairn/localization/stream_binding.hpp"
#include "cairn/maps/map_set.hpp"
#include "cairn/sensing/stream_info.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace cairn {

/// Where a localizer begins: near a pose (T_map_base, spread as InitialOptions say), or anywhere free.
struct Start {
  std::optional<Pose2> T_map_base;
};

/// Monte Carlo localization (Thrun et al., Probabilistic Robotics, table 8.2; with KLD-sampling, table 8.4)
/// on one odometry stream and any number of laser streams: a FusionLocalizer with the particle filter that
/// the options' recipe names.
class MonteCarloLocalizer final : public FusionLocalizer {
 public:
  /// @param streams table that Event::stream indexes
  /// @param maps the main one has an occupancy grid
  /// @param cost_clock what updates cost, for the scheduler; null: modelled, so that every run replays
  /// @param places prepared beforehand, for recipes that draw samples of p(x | z); the same results without
  /// @throws ConfigurationError if the options do not fit the streams or the map, or the start is off the map
  MonteCarloLocalizer(const LocalizerOptions& options, const std::vector<StreamInfo>& streams,
                      const MapLibrary& maps, const Start& start, std::uint64_t seed,
                      std::shared_ptr<const Executor> executor,
                      std::unique_ptr<CostClock> cost_clock = nullptr, const PlaceIndices& places = {});
};

}  // namespace cairn
