#pragma once

#include "apps/cairn/posed_scans.hpp"
#include "apps/cairn/time_spans.hpp"
#include "cairn/maps/occupancy_grid.hpp"
#include "cairn/models/sensor/beam_model_em.hpp"

#include <vector>

namespace cairn::app {

/// What a log tells about the beams of one scanner: readings, each with the range that the map has there.
struct BeamSamples {
  std::vector<BeamSample> learn;  ///< of the scans inside the spans
  std::vector<BeamSample> rest;   ///< of the others
  std::size_t scans = 0;          ///< inside the spans
  double max_range_m = 0.0;       ///< readings from here on are no returns
};

struct BeamSampleOptions {
  BeamLimits limits = {};
  int beams_per_scan = 30;          ///< evenly spread
  std::size_t most_scans = 4000;    ///< evenly spread over the log
  double largest_expected_m = 1e9;  ///< the map's range where the map has none
};

/// @param start  of the log, from which the spans count
/// @throws InputError if no scan inside the spans is usable
BeamSamples collect_beam_samples(const PosedScans& posed, const OccupancyGrid& map, Time start,
                                 const TimeSpans& spans, const BeamSampleOptions& options);

}  // namespace cairn::app
