#include "cairn/core/errors.hpp"
#include "cairn/localization/monte_carlo_localizer.hpp"

#include <algorithm>

namespace cairn {
namespace {

std::string names_of(const std::vector<StreamInfo>& streams, StreamKind kind) {
  std::string names;
  for (const StreamInfo& s : streams) {
    if (s.kind == kind) names += (names.empty() ? "" : ", ") + s.name;
  }
  return names.empty() ? "none" : names;
}

StreamId find_odometry(const std::vector<StreamInfo>& streams, const std::string& wanted) {
  const auto found = std::find_if(streams.begin(), streams.end(), [&](const StreamInfo& s) {
    return s.kind == StreamKind::kOdometry && (wanted.empty() || s.name == wanted);
  });
  if (found == streams.end()) {
    throw ConfigurationError(
        "odometry_stream",
        wanted.empty() ? "the log has no odometry" : "the log has no odometry '" + wanted + "'",
        "its odometry streams: " + names_of(streams, StreamKind::kOdometry));
  }
  return static_cast<StreamId>(found - streams.begin());
}

void check_names(const LocalizerOptions& options, const std::vector<StreamInfo>& streams) {
  for (const auto& [name, unused] : options.streams) {
    const bool known = std::any_of(streams.begin(), streams.end(), [&name = name](const StreamInfo& s) {
      return s.name == name && s.kind == StreamKind::kLaserScan;
    });
    if (!known) {
      throw ConfigurationError("streams." + name, "the log has no such laser stream",
                               "its laser streams: " + names_of(streams, StreamKind::kLaserScan));
    }
  }
}

}  // namespace

void MonteCarloLocalizer::bind_streams(const std::vector<StreamInfo>& streams, const MapLibrary& maps) {
  check_names(options_, streams);
  odometry_stream_ = find_odometry(streams, options_.odometry_stream);
  const LaserModelOptions coarse =
      widened(options_.laser, options_.global.sigma_hit_m, options_.global.effective_beams);
  bool any = false;
  for (const StreamInfo& stream : streams) {
    stream_names_.push_back(stream.name);
    laser_models_.emplace_back();
    if (stream.kind != StreamKind::kLaserScan) continue;
    const auto configured = options_.streams.find(stream.name);
    const bool named = configured != options_.streams.end();
    if (!named && !options_.streams.empty()) continue;
    const LaserStreamOptions laser = named ? configured->second : LaserStreamOptions{};
    if (!laser.use) continue;
    const Pose2 T_base_sensor =
        laser.mount_from_log && stream.T_base_sensor ? *stream.T_base_sensor : laser.T_base_sensor;
    LaserModels& models = laser_models_.back();
    const std::string& name = laser.model.empty() ? options_.laser.model : laser.model;
    const MapSet& map = maps.at(laser.map);
    models.fine = make_laser_model(name, {map, T_base_sensor, laser.limits, options_.laser});
    models.coarse = make_laser_model(name, {map, T_base_sensor, laser.limits, coarse});
    any = true;
  }
  if (!any) {
    throw ConfigurationError("streams", "no laser stream is in use",
                             "the log's laser streams: " + names_of(streams, StreamKind::kLaserScan));
  }
}

}  // namespace cairn
