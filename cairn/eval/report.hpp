#pragma once

#include "cairn/core/trajectory.hpp"
#include "cairn/localization/estimate.hpp"
#include "cairn/maps/occupancy_grid.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cairn {

/// The map of a report, as the picture that it shows.
struct ReportMap {
  std::string
      png;  ///< the file's bytes: grey, 0 occupied, 254 free, 205 unknown; first row = top (largest y)
  GridGeometry geometry;  ///< its size and place
};

/// One run, as the report shows it. Everything but the metrics may be empty or absent.
struct ReportData {
  std::string metrics;        ///< metrics.json: an object
  std::string configuration;  ///< YAML
  Trajectory trajectory;      ///< T_map_base
  std::vector<Estimate> estimates;
  std::vector<HypothesisSnapshot> hypotheses;
  std::vector<ParticleSnapshot> particles;
  std::optional<Trajectory> reference;  ///< T_map_base; without it the report shows no errors
  std::optional<ReportMap> map;
};

/// The report of a run: `page` (the template that web/ builds) with the run's data in place of its mark
/// `<!--CAIRN:RUN-->`. One self-contained HTML file; long series are thinned out to 4000 points (peaks stay),
/// the particles to 400 instants of 120, so that it stays under about 4 MB.
///
/// The data is one JSON object in which `<` is escaped, so that nothing in it can end the script element.
/// Times `t` are seconds since the first pose of the run; metres and radians; columns are arrays of equal
/// length:
/// - metrics, configuration: as given; bytes that are not UTF-8 become U+FFFD
/// - path, reference: columns t, x, y, theta
/// - belief: columns t, x, y, var_x, cov_xy, var_y, var_theta, ess, particles, hypotheses, weight, quality
///   and state (index into TrackingState), probability
/// - hypotheses: t, and places: x, y, var_x, cov_xy, var_y, weight, age_s of each place in turn, heaviest
/// first
/// - series: columns t, v for each of sigma_x_m, sigma_y_m, sigma_position_m, sigma_theta_rad, ess,
/// particles,
///   hypotheses, weight, quality, probability, and with a reference position_error_m, heading_error_rad
/// - errors: columns t, x, y, position_m, heading_rad (absolute), and the number p95_m of all errors; only
/// where reference and run overlap in time
/// - histograms: position (metres), heading (degrees), each {width, counts, beyond} of all errors; only with
///   errors
/// - particles: t, and mm: x, y (millimetres), heading (milliradians) of each particle in turn
/// - map: png (base64), width, height, resolution_m, origin [x, y, yaw]
/// @throws InputError for metrics that are not a JSON object; std::logic_error for a page without the mark.
std::string render_report(std::string_view page, const ReportData& run);

}  // namespace cairn
