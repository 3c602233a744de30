#include "cairn/localization/monte_carlo_localizer.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/localization/particle_pose_filter.hpp"
#include "cairn/localization/recipes.hpp"

namespace cairn {
namespace {

Pose2 sample_near(const Pose2& mean, const InitialOptions& o, const RandomStream& random,
                  std::uint32_t item) {
  const auto n = random.normal4(item);
  return {mean.x + o.sigma_x_m * n[0], mean.y + o.sigma_y_m * n[1],
          normalize_angle(mean.theta + o.sigma_yaw_rad * n[2])};
}

void start_near(const Pose2& pose, const GridGeometry& grid, const InitialOptions& spread,
                PoseFilter& filter) {
  const Point2 cell = grid.to_cells({pose.x, pose.y});
  const bool on_map =
      is_finite(pose) && cell.x >= 0.0 && cell.x < grid.width && cell.y >= 0.0 && cell.y < grid.height;
  if (!on_map) {
    throw ConfigurationError("start pose", "lies off the map",
                             "give x and y in metres, in the map's frame (see `cairn map info`)");
  }
  filter.initialize(
      [&](const RandomStream& random, std::uint32_t i) { return sample_near(pose, spread, random, i); });
}

// Recipes whose filter injects particles by itself do as their papers say.
bool has_own_recovery(const std::string& recipe) {
  return recipe == "amcl" || recipe == "srl" || recipe == "kld_srl" || recipe == "csrl" ||
         recipe == "ckld_srl";
}

// Recovery on a large map would take the memory of the machine, once the robot is lost.
std::optional<Recovery> make_recovery(const LocalizerOptions& options, const GridGeometry& map,
                                      std::uint64_t seed, Diagnostics& diagnostics) {
  if (!options.recovery.active || has_own_recovery(options.recipe)) return std::nullopt;
  const double millions = static_cast<double>(map.size()) / 1e6;
  if (millions <= options.recovery.most_million_cells) return Recovery(options.recovery, seed);
  diagnostics.warn("no recovery", "map of " + std::to_string(std::lround(millions)) + " million cells",
                   "a lost robot will not be looked for: that takes about 60 bytes per cell; raise "
                   "recovery.most_million_cells, or use a coarser map");
  return std::nullopt;
}

// Likewise the search for a robot that may be anywhere.
LocalizerOptions within_memory(LocalizerOptions options, const GridGeometry& map, const Start& start,
                               Diagnostics& diagnostics) {
  const double millions = static_cast<double>(map.size()) / 1e6;
  if (start.T_map_base || options.global.most_poses == 0 || millions <= options.global.most_million_cells)
    return options;
  options.global.most_poses = 0;
  diagnostics.warn(
      "no search", "map of " + std::to_string(std::lround(millions)) + " million cells",
      "only the first scan chooses where the robot may be, and a wrong place may be claimed: a search "
      "takes about 60 bytes per cell; raise global.most_million_cells, or use a coarser map");
  return options;
}

// Where a log tells the mount of a scanner, that of the configuration is not used unless it is asked for.
void warn_of_unused_mounts(const LocalizerOptions& options, const std::vector<StreamInfo>& streams,
                           Diagnostics& diagnostics) {
  for (const StreamInfo& stream : streams) {
    const auto found = options.streams.find(stream.name);
    if (found == options.streams.end() || !found->second.use || !found->second.mount_from_log) continue;
    const Pose2& given = found->second.T_base_sensor;
    const bool set = given.x != 0.0 || given.y != 0.0 || given.theta != 0.0;
    if (set && stream.T_base_sensor)
      diagnostics.warn("mount of the configuration not used: the log tells one", "stream " + stream.name,
                       "the log tells where it is mounted; set streams." + stream.name +
                           ".mount_from_log=false to use the mount of the configuration");
  }
}

FusionParts compose(const LocalizerOptions& given, const std::vector<StreamInfo>& streams,
                    const MapLibrary& maps, const Start& start, std::uint64_t seed,
                    std::shared_ptr<const Executor> executor, std::unique_ptr<CostClock> cost_clock,
                    const PlaceIndices& places) {
  given.validate();
  FusionParts parts;
  const auto map = maps.main().grid();
  const LocalizerOptions options = within_memory(given, map->geometry(), start, parts.diagnostics);
  parts.streams = bind_streams(options, streams, maps, places);
  warn_of_unused_mounts(options, streams, parts.diagnostics);
  parts.filter = std::make_unique<ParticlePoseFilter>(make_filter(options, seed, executor, map.get()),
                                                      options.random_walk);
  if (start.T_map_base) {
    start_near(*start.T_map_base, map->geometry(), options.initial, *parts.filter);
  } else {
    parts.global_search = GlobalSearch(options.global);
    parts.global_start = std::make_unique<GlobalStart>(*map, options.global.candidates_per_m2, seed);
  }
  parts.cost_clock =
      cost_clock ? std::move(cost_clock) : std::make_unique<ModelledCost>(options.scheduler.cost_ns);
  parts.trigger = {options.update, options.random_walk};
  parts.monitor = options.monitor;
  parts.recovery = make_recovery(options, map->geometry(), seed, parts.diagnostics);
  parts.time = options.time;
  parts.scheduler = options.scheduler;
  parts.executor = std::move(executor);
  return parts;
}

}  // namespace

MonteCarloLocalizer::MonteCarloLocalizer(const LocalizerOptions& options,
                                         const std::vector<StreamInfo>& streams, const MapLibrary& maps,
                                         const Start& start, std::uint64_t seed,
                                         std::shared_ptr<const Executor> executor,
                                         std::unique_ptr<CostClock> cost_clock, const PlaceIndices& places)
    : FusionLocalizer(
          compose(options, streams, maps, start, seed, std::move(executor), std::move(cost_clock), places)) {}

}  // namespace cairn
