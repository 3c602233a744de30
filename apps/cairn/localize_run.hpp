#pragma once

#include "apps/cairn/stream_maps.hpp"
#include "cairn/io/log.hpp"
#include "cairn/localization/estimate.hpp"
#include "cairn/localization/localizer_options.hpp"
#include "cairn/localization/monte_carlo_localizer.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace cairn::app {

/// One run of a localizer over a log.
struct LocalizeRequest {
  const Log* log = nullptr;  ///< events in the order in which the localizer takes them
  std::shared_ptr<const OccupancyGrid> map;
  std::shared_ptr<const MapSet> maps =
      nullptr;  ///< of the same place, in every representation; null: the grid
  /// Of the streams that have their own (streams.<name>.map), in the frame of `map`; by that name.
  StreamMaps stream_maps = {};
  LocalizerOptions options;
  PlaceIndices places = {};  ///< by stream; those that are missing are made while it runs
  Start start;
  std::uint64_t seed = 1;
  int threads = 1;
  /// The estimates are what the robot has at each moment: after every message, the belief carried on to the
  /// newest odometry, wherever that moved on. Otherwise they are the beliefs at the measurements' stamps.
  bool live = false;
  /// Told every event before the localizer takes it, and every estimate when it comes: for a recorder.
  std::function<void(const Event&)> on_event = [](const Event&) {};
  std::function<void(const Estimate&)> on_estimate = [](const Estimate&) {};
  /// Asked after every event with the number of events done; false ends the run there.
  std::function<bool(std::int64_t)> go_on = [](std::int64_t) { return true; };
};

struct LocalizeResult {
  /// One per scan that was used or not needed, or (live) one per moment: see LocalizeRequest::live.
  std::vector<Estimate> estimates;
  std::vector<HypothesisSnapshot> hypotheses;  ///< with every estimate
  std::vector<ParticleSnapshot> snapshots;     ///< evenly spread over the run
  std::vector<OutcomeCounts> outcomes;         ///< per stream of the log
  Diagnostics diagnostics;
  std::int64_t updates = 0;
  bool interrupted = false;
  double prepare_s = 0.0;  ///< wall time until the first event
  double run_s = 0.0;      ///< wall time of the events
};

/// @throws ConfigurationError as MonteCarloLocalizer
LocalizeResult localize(const LocalizeRequest& request);

/// How the belief looks at the end of a run, without knowing the truth.
struct EndVerdict {
  bool lost = true;
  std::string reason;  ///< one sentence
};
EndVerdict judge_end(const std::vector<Estimate>& estimates);

}  // namespace cairn::app
