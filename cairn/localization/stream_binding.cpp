#include "cairn/localization/stream_binding.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/localization/laser_locator.hpp"
#include "cairn/localization/recipes.hpp"
#include "cairn/models/derived_maps.hpp"
#include "cairn/models/search/place_sampler.hpp"
#include "cairn/models/sensor/place_fit.hpp"
#include "cairn/models/sensor/scan_continuity.hpp"

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

constexpr const char* kNoOdometry = "none";

std::optional<StreamId> find_odometry(const std::vector<StreamInfo>& streams, const std::string& wanted) {
  if (wanted == kNoOdometry) return std::nullopt;
  const auto found = std::find_if(streams.begin(), streams.end(), [&](const StreamInfo& s) {
    return s.kind == StreamKind::kOdometry && (wanted.empty() || s.name == wanted);
  });
  if (found == streams.end()) {
    throw ConfigurationError(
        "odometry_stream",
        wanted.empty() ? "the log has no odometry" : "the log has no odometry '" + wanted + "'",
        "its odometry streams: " + names_of(streams, StreamKind::kOdometry) + "; `none` does without");
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

/// What a laser stream is made of.
struct LaserParts {
  std::shared_ptr<const LaserModel> fine;
  std::shared_ptr<const LaserModel> coarse;
  std::unique_ptr<const BeamSkipping> skipping;  ///< null: all beams count
  std::unique_ptr<const LaserLocator> start;     ///< null: the search for the start is switched off
  std::unique_ptr<const LaserLocator> recovery;  ///< null: recovery is switched off
  std::shared_ptr<const BeamClassifier> classes;
  std::unique_ptr<const PlaceFit> fit;  ///< null: recovery is switched off
  ScanContinuity continuity;
  bool recovers = false;                ///< a robot that was carried away is looked for
  std::optional<PlaceSampler> sampler;  ///< only for recipes that draw samples of p(x | z)
  BeamLimits limits;
  int max_beams = 0;
  double cost = 1.0;
};

// A laser scanner: one sensor model at two widths, searches over the whole map, classes of beams,
// and what takes dynamic obstacles from its scans.
class LaserStream final : public StreamModel {
 public:
  explicit LaserStream(LaserParts parts) : parts_(std::move(parts)) {}

  BoundUpdate<Pose2> bind(const Event::Payload& z, bool compact) const override {
    return with_samples((compact ? parts_.fine : parts_.coarse)->bind(scan_of(z)), z);
  }
  bool informs(const Event::Payload& z) const override {
    return parts_.fine->reads_no_returns() || !select_beams(scan_of(z), parts_.limits, 1).empty();
  }
  // Over several places no beam is expected anywhere: they all count.
  BoundUpdate<Pose2> bind_given(const Event::Payload& z, bool compact,
                                const BeliefSample& belief) const override {
    if (!parts_.skipping || !compact) return bind(z, compact);
    return with_samples(
        parts_.fine->bind(parts_.skipping->expected_part(scan_of(z), belief(kSkippingSample))), z);
  }
  double explained_share(const Event::Payload& z, const Pose2& T_map_base) const override {
    return parts_.fine->explained_share(scan_of(z), T_map_base);
  }
  std::vector<LocatedPose> locate(std::span<const Glimpse> way, std::span<const Pose2> asked) const override {
    return parts_.start ? parts_.start->locate(way, asked) : std::vector<LocatedPose>{};
  }
  std::optional<std::vector<LocatedPose>> search(std::span<const Glimpse> glimpses) const override {
    if (!parts_.recovery) return std::nullopt;
    return parts_.recovery->search(glimpses);
  }
  bool follow(const Event::Payload& z, std::span<Pose2> places, std::span<double> fits) const override {
    if (!parts_.fit) return false;
    for (std::size_t i = 0; i < places.size(); ++i) fits[i] = parts_.fit->follow(scan_of(z), places[i]);
    return true;
  }
  std::optional<BeamShares> classify(const Event::Payload& z, const Pose2& T_map_base) const override {
    return parts_.classes->classify(scan_of(z), T_map_base);
  }
  bool can_continue() const override { return parts_.recovers; }
  bool can_continue(const Event::Payload& z) const override { return parts_.recovers && can_compare(z); }
  std::optional<double> continued_share(const Event::Payload& before, const Event::Payload& now,
                                        const Pose2& T_before_now) const override {
    if (!parts_.recovers) return std::nullopt;
    return parts_.continuity.share(scan_of(before), scan_of(now), T_before_now);
  }
  bool can_compare(const Event::Payload& z) const override { return parts_.continuity.can_tell(scan_of(z)); }
  std::optional<double> closeness(const Event::Payload& before, const Event::Payload& now,
                                  const Pose2& T_before_now) const override {
    return parts_.continuity.closeness(scan_of(before), scan_of(now), T_before_now);
  }
  double beams(const Event::Payload& z) const override {
    const auto beams = static_cast<double>(scan_of(z).ranges_m.size());
    return parts_.cost *
           (parts_.max_beams > 0 ? std::min(beams, static_cast<double>(parts_.max_beams)) : beams);
  }

 private:
  static const LaserScan& scan_of(const Event::Payload& z) {
    return *std::get<std::shared_ptr<const LaserScan>>(z);
  }

  BoundUpdate<Pose2> with_samples(BoundUpdate<Pose2> bound, const Event::Payload& z) const {
    if (parts_.sampler)
      bound.sample =
          parts_.sampler->bind(std::get<std::shared_ptr<const LaserScan>>(z), bound.log_likelihood);
    return bound;
  }

  static constexpr std::size_t kSkippingSample = 100;  // shares to 5 %

  LaserParts parts_;
};

LaserLocator::Options start_search(const LocalizerOptions& options) {
  LaserLocator::Options o{.likelihood = options.laser.likelihood_field, .search = {}};
  o.likelihood.sigma_hit_m = options.global.search_sigma_m;
  o.search.most_poses = options.global.most_poses;
  o.search.effective_beams = options.global.effective_beams;
  o.search.millions_of_points = options.global.search_millions;
  o.further_beams = options.global.look_beams;
  return o;
}

LaserLocator::Options recovery_search(const LocalizerOptions& options) {
  const RecoveryOptions& recovery = options.recovery;
  LaserLocator::Options o{.likelihood = options.laser.likelihood_field, .search = {}};
  o.likelihood.sigma_hit_m = recovery.sigma_hit_m;
  o.search.most_poses = recovery.most_poses;
  o.search.effective_beams = recovery.effective_beams;
  o.search.millions_of_points = recovery.millions_of_points;
  o.further_beams = recovery.further_beams;
  o.crowd_m = recovery.crowd_m;
  return o;
}

std::shared_ptr<const BeamClassifier> make_classifier(const MapSet& map, const LocalizerOptions& options,
                                                      const Pose2& T_base_sensor, const BeamLimits& limits) {
  return std::make_shared<const BeamClassifier>(
      map.grid(), distance_field_of(map, options.laser.likelihood_field.max_distance_m),
      ray_marcher_of(map, limits.max_range_m), T_base_sensor, limits);
}

std::optional<PlaceSampler> make_sampler(const MapSet& map, const LocalizerOptions& options,
                                         const std::string& stream, const PlaceIndices& places,
                                         const Pose2& T_base_sensor, const BeamLimits& limits) {
  if (!samples_from_measurements(options.recipe)) return std::nullopt;
  const auto known = places.find(stream);
  return PlaceSampler(map.grid(), known == places.end() ? nullptr : known->second, T_base_sensor, limits);
}

std::unique_ptr<const StreamModel> bind_laser(const LocalizerOptions& options,
                                              const LaserStreamOptions& laser, const StreamInfo& stream,
                                              const MapLibrary& maps, const PlaceIndices& places) {
  const Pose2 T_base_sensor =
      laser.mount_from_log && stream.T_base_sensor ? *stream.T_base_sensor : laser.T_base_sensor;
  const std::string& name = laser.model.empty() ? options.laser.model : laser.model;
  LaserModelOptions fine = options.laser;
  double coarse_beams = options.global.effective_beams;
  if (laser.effective_beams > 0.0) {
    fine = with_effective_beams(fine, laser.effective_beams);
    coarse_beams = std::min(coarse_beams, laser.effective_beams);
  }
  const LaserModelOptions coarse = widened(options.laser, options.global.sigma_hit_m, coarse_beams);
  const MapSet& map = maps.at(laser.map);
  std::unique_ptr<const BeamSkipping> skipping;
  if (const BeamSkippingOptions& skip = options.laser.beam_skip; skip.use) {
    const double reach_m = std::max(skip.distance_m, options.laser.likelihood_field.max_distance_m);
    skipping = std::make_unique<const BeamSkipping>(distance_field_of(map, reach_m), T_base_sensor,
                                                    laser.limits, skip);
  }
  auto model = make_laser_model(name, {map, T_base_sensor, laser.limits, fine});
  if (options.recipe == "cgr" && !model->bind(LaserScan{}).gradient) {
    throw ConfigurationError("recipe", "cgr needs the gradient of a sensor model, '" + name + "' has none",
                             "use laser.model=likelihood_field_prob, v_amcl, vector_laser, ndt or ondt");
  }
  LaserParts parts{.fine = std::move(model),
                   .coarse = make_laser_model(name, {map, T_base_sensor, laser.limits, coarse}),
                   .skipping = std::move(skipping),
                   .start = nullptr,
                   .recovery = nullptr,
                   .classes = make_classifier(map, options, T_base_sensor, laser.limits),
                   .fit = nullptr,
                   .continuity = ScanContinuity(T_base_sensor, laser.limits),
                   .sampler = make_sampler(map, options, stream.name, places, T_base_sensor, laser.limits),
                   .limits = laser.limits,
                   .max_beams = options.laser.likelihood_field.max_beams,
                   .cost = laser.cost};
  const auto locator = [&](const LaserLocator::Options& how) {
    return std::make_unique<const LaserLocator>(map.grid(), T_base_sensor, laser.limits, how);
  };
  if (options.global.most_poses > 0) parts.start = locator(start_search(options));
  if (options.recovery.active) {
    parts.recovery = locator(recovery_search(options));
    parts.recovers = true;
    parts.fit = std::make_unique<const PlaceFit>(
        parts.classes, distance_field_of(map, options.laser.likelihood_field.max_distance_m), T_base_sensor,
        laser.limits);
  }
  return std::make_unique<const LaserStream>(std::move(parts));
}

// How a laser stream is to be used; nullopt: not at all.
std::optional<LaserStreamOptions> options_of(const LocalizerOptions& options, const StreamInfo& stream) {
  if (stream.kind != StreamKind::kLaserScan) return std::nullopt;
  const auto configured = options.streams.find(stream.name);
  const bool named = configured != options.streams.end();
  if (!named && !options.streams.empty()) return std::nullopt;
  const LaserStreamOptions laser = named ? configured->second : LaserStreamOptions{};
  return laser.use ? std::optional(laser) : std::nullopt;
}

}  // namespace

StreamBindings bind_streams(const LocalizerOptions& options, const std::vector<StreamInfo>& streams,
                            const MapLibrary& maps, const PlaceIndices& places) {
  check_names(options, streams);
  StreamBindings bindings;
  bindings.odometry = find_odometry(streams, options.odometry_stream);
  for (const StreamInfo& stream : streams) {
    bindings.names.push_back(stream.name);
    bindings.models.emplace_back();
    bindings.stamp_offsets.emplace_back();
    bindings.shares.emplace_back();
    bindings.periods.emplace_back();
    const auto laser = options_of(options, stream);
    if (!laser) continue;
    bindings.models.back() = bind_laser(options, *laser, stream, maps, places);
    bindings.stamp_offsets.back() = duration_from_seconds(laser->stamp_offset_s);
    bindings.shares.back().nice = laser->nice;
    if (laser->rate_hz > 0.0) bindings.shares.back().rate_hz = laser->rate_hz;
    if (laser->period_s > 0.0) bindings.periods.back() = duration_from_seconds(laser->period_s);
  }
  const bool any = std::any_of(bindings.models.begin(), bindings.models.end(),
                               [](const auto& model) { return model != nullptr; });
  if (!any) {
    throw ConfigurationError("streams", "no laser stream is in use",
                             "the log's laser streams: " + names_of(streams, StreamKind::kLaserScan));
  }
  return bindings;
}

}  // namespace cairn
