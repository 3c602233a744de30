#pragma once

#include "apps/cairn/posed_scans.hpp"
#include "cairn/maps/occupancy_grid.hpp"
#include "cairn/models/sensor/beam_model_em.hpp"
#include "cairn/models/sensor/late_ranges.hpp"
#include "cairn/sim/world_options.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cairn::app {

/// Where the beacons of a log hang, and the antenna that measures their ranges.
struct BeaconSites {
  struct Site {
    Point2 at;
    double height_m = 0.0;
  };
  std::map<std::string, Site> sites;  ///< by id
  Pose2 T_base_antenna;
  double antenna_height_m = 0.0;
};

/// Those of a world: all its beacons, and its first beacon radio. nullopt if it has none.
std::optional<BeaconSites> beacon_sites(const WorldOptions& world);

/// A recording, where its robot was, and what stood there.
struct SensorErrorInputs {
  const Log& log;  ///< sorted by stamp
  const Trajectory& reference;
  const OccupancyGrid& map;
  PosedScanOptions scans;  ///< which laser, and whose poses the reference holds
  std::string odometry;    ///< stream; empty: the first one
  std::optional<BeaconSites> beacons = std::nullopt;
};

/// How a recording's sensors err, told in the same way of real and simulated ones. Samples are measured minus
/// expected, metres or radians.
struct SensorErrors {
  /// The beam mixture (learn_beam_model): hit_share, short_share, max_share, random_share, sigma_hit_m.
  /// no_return_share: of beams towards a wall of the map within nine tenths of the reach.
  /// standing_sigma_m: noise of a range, by the same beam of two scans of a standing robot; may be missing.
  /// scan_to_scan_sigma_m (robust), scan_to_scan_far_share (beyond half a metre): pair_scans.
  /// Per metre, over half metres: odometry_bias_m, odometry_sigma_m, heading_bias_rad, heading_sigma_rad.
  /// Per full turn, over half radians on less than half a metre: turn_bias_rad, turn_sigma_rad.
  /// Over all beacons (fit_late_ranges): uwb_bias_m, uwb_sigma_m, uwb_wrong_share, uwb_late_share,
  /// uwb_late_mean_m.
  std::map<std::string, double> metrics;
  /// beam, scan_to_scan, odometry (per metre), heading (per metre), turn (per full turn), uwb.
  std::map<std::string, std::vector<double>> samples;
  std::optional<LateRangeFit> uwb;
  std::vector<std::string> beacons;  ///< ids, in the order of uwb->beacons
};

/// Needs a laser and odometry; measures what else there is.
/// @throws InputError, ConfigurationError as pose_scans, collect_beam_samples, fit_late_ranges
SensorErrors measure_sensor_errors(const SensorErrorInputs& inputs);

/// Evenly spread quantiles of a sample, the smallest first and the largest last. @pre sample not empty
std::vector<double> quantiles(std::vector<double> sample, std::size_t count);

}  // namespace cairn::app
