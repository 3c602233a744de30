#include "apps/cairn/sensor_errors.hpp"

#include "apps/cairn/beam_samples.hpp"
#include "apps/cairn/odometry_path.hpp"
#include "apps/cairn/scan_pairs.hpp"
#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/models/motion/odometry_calibration.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cairn::app {
namespace {

constexpr double kFar_m = 0.5;
constexpr std::size_t kFewest = 20;
constexpr std::size_t kFewestStanding = 500;
constexpr double kNearLimit = 0.9;  // of the reach: farther walls may be missed rightly

struct Moments {
  double mean = 0.0, sigma = 0.0;
};

Moments moments_of(const std::vector<double>& sample) {
  const auto n = static_cast<double>(sample.size());
  const double mean = std::accumulate(sample.begin(), sample.end(), 0.0) / n;
  double squares = 0.0;
  for (const double value : sample) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / n)};
}

double robust_sigma(const std::vector<double>& sample) {
  std::vector<double> sizes;
  sizes.reserve(sample.size());
  for (const double value : sample) sizes.push_back(std::abs(value));
  return 1.4826 * quantiles(std::move(sizes), 3)[1];
}

void add_beams(const SensorErrorInputs& inputs, const PosedScans& posed, SensorErrors& errors) {
  BeamSampleOptions options;
  options.beams_per_scan = 60;
  options.most_scans = 2000;
  const BeamSamples beams = collect_beam_samples(posed, inputs.map, inputs.log.events.front().stamp,
                                                 TimeSpans("spans", ""), options);
  const BeamEmResult learnt = learn_beam_model(beams.learn, beams.max_range_m, {});
  const BeamModelOptions& o = learnt.options();
  auto& m = errors.metrics;
  m["hit_share"] = o.z_hit;
  m["short_share"] = o.z_short;
  m["max_share"] = o.z_max;
  m["random_share"] = o.z_rand;
  m["sigma_hit_m"] = o.sigma_hit_m;
  double towards_walls = 0.0, missed = 0.0;
  for (const BeamSample& beam : beams.learn) {
    if (beam.expected_m > kNearLimit * beams.max_range_m) continue;
    towards_walls += 1.0;
    if (beam.z_m >= beams.max_range_m) {
      missed += 1.0;
    } else {
      errors.samples["beam"].push_back(beam.z_m - beam.expected_m);
    }
  }
  m["no_return_share"] = missed / std::max(1.0, towards_walls);
}

void add_scan_pairs(const ScanPairs& pairs, SensorErrors& errors) {
  if (pairs.moving.size() < kFewest) return;
  std::vector<double> near;
  for (const double d : pairs.moving) {
    if (std::abs(d) <= kFar_m) near.push_back(d);
  }
  errors.metrics["scan_to_scan_far_share"] =
      1.0 - static_cast<double>(near.size()) / static_cast<double>(pairs.moving.size());
  if (near.size() >= kFewest) errors.metrics["scan_to_scan_sigma_m"] = robust_sigma(near);
  errors.samples["scan_to_scan"] = std::move(near);
  // Edges flip between surfaces: what differs by more than 10 cm is no noise of the range.
  double squares = 0.0, count = 0.0;
  for (const double d : pairs.standing) {
    if (std::abs(d) > 0.1) continue;
    squares += d * d;
    count += 1.0;
  }
  if (count >= kFewestStanding) errors.metrics["standing_sigma_m"] = std::sqrt(0.5 * squares / count);
}

void add_odometry(const SensorErrorInputs& inputs, const Trajectory& odometry, SensorErrors& errors) {
  constexpr double kNever = 1e3, kStep_m = 0.5, kTurn_rad = 0.5;
  const Duration gap = duration_from_seconds(inputs.scans.max_gap_s);
  for (const MotionChain& chain : cut_motions(odometry, inputs.reference, {kStep_m, kNever, gap})) {
    for (const MotionPair& pair : chain) {
      const double way = std::hypot(pair.truth.x, pair.truth.y);
      if (way < 0.3 * kStep_m) continue;
      errors.samples["odometry"].push_back((std::hypot(pair.told.x, pair.told.y) - way) / way);
      errors.samples["heading"].push_back(normalize_angle(pair.told.theta - pair.truth.theta) / way);
    }
  }
  for (const MotionChain& chain : cut_motions(odometry, inputs.reference, {kStep_m, kTurn_rad, gap})) {
    for (const MotionPair& pair : chain) {
      if (std::abs(pair.told.theta) < kTurn_rad) continue;  // it has driven instead
      const double sign = pair.told.theta < 0.0 ? -1.0 : 1.0;
      const double error = sign * normalize_angle(pair.told.theta - pair.truth.theta);
      errors.samples["turn"].push_back(error * kTwoPi / std::abs(pair.told.theta));
    }
  }
  const auto add = [&errors](const char* sample, const char* bias, const char* sigma) {
    if (errors.samples[sample].size() < kFewest) return;
    const Moments moments = moments_of(errors.samples[sample]);
    if (*bias != '\0') errors.metrics[bias] = moments.mean;
    errors.metrics[sigma] = moments.sigma;
  };
  add("odometry", "odometry_bias_m", "odometry_sigma_m");
  add("heading", "heading_bias_rad", "heading_sigma_rad");
  add("turn", "turn_bias_rad", "turn_sigma_rad");
}

std::vector<std::vector<double>> range_errors(const SensorErrorInputs& inputs, SensorErrors& errors) {
  const BeaconSites& known = *inputs.beacons;
  std::map<std::string, std::vector<double>> by_beacon;
  for (const Event& event : inputs.log.events) {
    const auto* ranges = std::get_if<std::shared_ptr<const BeaconRanges>>(&event.payload);
    if (ranges == nullptr) continue;
    const auto pose =
        pose_without_gap(inputs.reference, event.stamp, duration_from_seconds(inputs.scans.max_gap_s));
    if (!pose) continue;
    const Pose2 antenna = *pose * known.T_base_antenna;
    for (const BeaconReading& reading : (*ranges)->readings) {
      const auto site = known.sites.find(reading.id);
      if (site == known.sites.end() || std::isnan(reading.range_m)) continue;
      const double flat = std::hypot(site->second.at.x - antenna.x, site->second.at.y - antenna.y);
      by_beacon[reading.id].push_back(reading.range_m -
                                      std::hypot(flat, site->second.height_m - known.antenna_height_m));
    }
  }
  std::vector<std::vector<double>> groups;
  for (auto& [id, group] : by_beacon) {
    errors.beacons.push_back(id);
    errors.samples["uwb"].insert(errors.samples["uwb"].end(), group.begin(), group.end());
    groups.push_back(std::move(group));
  }
  return groups;
}

void add_beacons(const SensorErrorInputs& inputs, SensorErrors& errors) {
  const std::vector<std::vector<double>> groups = range_errors(inputs, errors);
  if (groups.empty()) return;
  const LateRangeFit fit = fit_late_ranges(groups);
  double total = 0.0, late = 0.0, delay = 0.0, wrong = 0.0;
  for (const LateRangeFit::Beacon& beacon : fit.beacons) {
    const auto n = static_cast<double>(beacon.count);
    total += n;
    const double late_ranges = n * (1.0 - beacon.wrong_share) * beacon.late_share;
    wrong += n * beacon.wrong_share;
    late += late_ranges;
    delay += late_ranges * beacon.late_mean_m;
  }
  errors.metrics["uwb_bias_m"] = fit.bias_m;
  errors.metrics["uwb_sigma_m"] = fit.sigma_m;
  errors.metrics["uwb_late_share"] = late / total;
  if (late > 0.0) errors.metrics["uwb_late_mean_m"] = delay / late;
  errors.metrics["uwb_wrong_share"] = wrong / total;
  errors.uwb = fit;
}

}  // namespace

std::vector<double> quantiles(std::vector<double> sample, std::size_t count) {
  std::sort(sample.begin(), sample.end());
  std::vector<double> values;
  for (std::size_t k = 0; k < count; ++k) {
    const double rank =
        static_cast<double>(k) / static_cast<double>(count - 1) * static_cast<double>(sample.size() - 1);
    const auto below = static_cast<std::size_t>(rank);
    const std::size_t above = std::min(below + 1, sample.size() - 1);
    values.push_back(std::lerp(sample[below], sample[above], rank - static_cast<double>(below)));
  }
  return values;
}

std::optional<BeaconSites> beacon_sites(const WorldOptions& world) {
  if (world.beacons.empty() || world.beacon_radios.empty()) return std::nullopt;
  BeaconSites sites;
  for (const WorldTransmitterOptions& beacon : world.beacons)
    sites.sites[beacon.name] = {parse_point("beacons." + beacon.name + ".at", beacon.at), beacon.height_m};
  const WorldBeaconRadioOptions& radio = world.beacon_radios.front();
  sites.T_base_antenna = parse_world_pose("beacon_radios." + radio.name + ".mount", radio.mount);
  sites.antenna_height_m = radio.height_m;
  return sites;
}

SensorErrors measure_sensor_errors(const SensorErrorInputs& inputs) {
  SensorErrors errors;
  const PosedScans posed = pose_scans(inputs.log, inputs.reference, inputs.scans);
  const Trajectory odometry = odometry_path(inputs.log, inputs.odometry);
  add_beams(inputs, posed, errors);
  const StreamId laser = laser_stream(inputs.log, inputs.scans.stream);
  Pose2 T_base_laser =
      inputs.scans.T_base_sensor.value_or(inputs.log.streams[laser].T_base_sensor.value_or(Pose2{}));
  if (inputs.scans.trajectory_is_of_sensor) T_base_laser = {};
  add_scan_pairs(pair_scans(inputs.log, laser, odometry, T_base_laser), errors);
  add_odometry(inputs, odometry, errors);
  if (inputs.beacons) add_beacons(inputs, errors);
  std::erase_if(errors.samples, [](const auto& entry) { return entry.second.size() < kFewest; });
  return errors;
}

}  // namespace cairn::app
