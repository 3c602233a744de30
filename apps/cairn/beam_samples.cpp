#include "apps/cairn/beam_samples.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/maps/ray_marching.hpp"
#include "cairn/models/sensor/beam_model.hpp"

#include <algorithm>
#include <cmath>

namespace cairn::app {
namespace {

double diagonal_m(const GridGeometry& grid) {
  return std::hypot(grid.width, grid.height) * grid.resolution_m;
}

void add_samples(const PosedScan& posed, const RayMarcher& map, const BeamSampleOptions& options,
                 std::vector<BeamSample>& out) {
  const auto readings = select_readings(*posed.scan, options.limits, options.beams_per_scan);
  std::vector<double> bearings;
  bearings.reserve(readings.size());
  for (const BeamReading& reading : readings) bearings.push_back(reading.bearing_rad);
  std::vector<float> expected(readings.size());
  expect_ranges(map, std::span(&posed.T_map_sensor, 1), bearings, expected);
  for (std::size_t k = 0; k < readings.size(); ++k) {
    const double r = expected[k] < map.max_range_m() ? expected[k] : options.largest_expected_m;
    out.push_back({readings[k].range_m, r});
  }
}

}  // namespace

BeamSamples collect_beam_samples(const PosedScans& posed, const OccupancyGrid& map, Time start,
                                 const TimeSpans& spans, const BeamSampleOptions& options) {
  const RayMarcher marcher(map, std::min(options.limits.max_range_m, diagonal_m(map.geometry())));
  const std::size_t step = posed.scans.size() / std::max<std::size_t>(1, options.most_scans) + 1;
  BeamSamples samples;
  for (std::size_t i = 0; i < posed.scans.size(); i += step) {
    const PosedScan& scan = posed.scans[i];
    const bool learns = spans.contains(scan.scan->stamp - start);
    samples.max_range_m = std::max(samples.max_range_m, reach_m(*scan.scan, options.limits));
    samples.scans += learns ? 1 : 0;
    add_samples(scan, marcher, options, learns ? samples.learn : samples.rest);
  }
  if (samples.learn.empty()) {
    throw InputError("log", "no scan with a pose lies inside the spans",
                     "check that log and reference are of the same run and clock");
  }
  return samples;
}

}  // namespace cairn::app
