#include "cairn/localization/stream_binding.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/models/derived_maps.hpp"
#include "cairn/models/search/one_shot.hpp"

#include <algorithm>
#include <mutex>

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

/// Finds a scanner's poses anywhere on a map; the map is prepared when that is first asked for.
class LaserLocator {
 public:
  LaserLocator(std::shared_ptr<const OccupancyGrid> map, const LocalizerOptions& options,
               const Pose2& T_base_sensor, const BeamLimits& limits)
      : map_(std::move(map)),
        model_(options.laser.likelihood_field),
        T_base_sensor_(T_base_sensor),
        limits_(limits) {
    search_options_.most_poses = options.global.most_poses;
    search_options_.effective_beams = options.global.effective_beams;
  }

  std::vector<LocatedPose> locate(const LaserScan& scan) const {
    std::call_once(prepared_, [this] { search_ = std::make_unique<const PoseSearch>(*map_, model_); });
    const auto points = select_end_points(scan, T_base_sensor_, limits_, kSearchedBeams);
    return cairn::locate(*search_, points, search_options_).poses;
  }

 private:
  static constexpr int kSearchedBeams = 180;
  std::shared_ptr<const OccupancyGrid> map_;
  LikelihoodFieldOptions model_;
  Pose2 T_base_sensor_;
  BeamLimits limits_;
  OneShotOptions search_options_;
  mutable std::once_flag prepared_;
  mutable std::unique_ptr<const PoseSearch> search_;
};

// A laser scanner: one sensor model at two widths, what takes dynamic obstacles from its scans, and a search
// over the whole map.
class LaserStream final : public StreamModel {
 public:
  LaserStream(std::shared_ptr<const LaserModel> fine, std::shared_ptr<const LaserModel> coarse,
              std::unique_ptr<const BeamSkipping> skipping, std::unique_ptr<const LaserLocator> locator,
              const BeamLimits& limits, int max_beams, double cost)
      : fine_(std::move(fine)),
        coarse_(std::move(coarse)),
        skipping_(std::move(skipping)),
        locator_(std::move(locator)),
        limits_(limits),
        max_beams_(max_beams),
        cost_(cost) {}

  BoundUpdate<Pose2> bind(const Event::Payload& z, bool compact) const override {
    return (compact ? fine_ : coarse_)->bind(scan_of(z));
  }
  bool informs(const Event::Payload& z) const override {
    return fine_->reads_no_returns() || !select_beams(scan_of(z), limits_, 1).empty();
  }
  // Over several places no beam is expected anywhere: they all count.
  BoundUpdate<Pose2> bind_given(const Event::Payload& z, bool compact,
                                const BeliefSample& belief) const override {
    if (!skipping_ || !compact) return bind(z, compact);
    return fine_->bind(skipping_->expected_part(scan_of(z), belief(kSkippingSample)));
  }
  double explained_share(const Event::Payload& z, const Pose2& T_map_base) const override {
    return fine_->explained_share(scan_of(z), T_map_base);
  }
  std::vector<LocatedPose> locate(const Event::Payload& z) const override {
    return locator_ ? locator_->locate(scan_of(z)) : std::vector<LocatedPose>{};
  }
  double beams(const Event::Payload& z) const override {
    const auto beams = static_cast<double>(scan_of(z).ranges_m.size());
    return cost_ * (max_beams_ > 0 ? std::min(beams, static_cast<double>(max_beams_)) : beams);
  }

 private:
  static const LaserScan& scan_of(const Event::Payload& z) {
    return *std::get<std::shared_ptr<const LaserScan>>(z);
  }

  static constexpr std::size_t kSkippingSample = 100;  // shares to 5 %

  std::shared_ptr<const LaserModel> fine_;
  std::shared_ptr<const LaserModel> coarse_;
  std::unique_ptr<const BeamSkipping> skipping_;  ///< null: all beams count
  std::unique_ptr<const LaserLocator> locator_;   ///< null: the search is switched off
  BeamLimits limits_;
  int max_beams_;
  double cost_;
};

std::unique_ptr<const StreamModel> bind_laser(const LocalizerOptions& options,
                                              const LaserStreamOptions& laser, const StreamInfo& stream,
                                              const MapLibrary& maps) {
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
  std::unique_ptr<const LaserLocator> locator;
  if (options.global.most_poses > 0)
    locator = std::make_unique<const LaserLocator>(map.grid(), options, T_base_sensor, laser.limits);
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
  return std::make_unique<const LaserStream>(
      std::move(model), make_laser_model(name, {map, T_base_sensor, laser.limits, coarse}),
      std::move(skipping), std::move(locator), laser.limits, options.laser.likelihood_field.max_beams,
      laser.cost);
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
                            const MapLibrary& maps) {
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
    bindings.models.back() = bind_laser(options, *laser, stream, maps);
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
