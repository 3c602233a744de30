#pragma once

#include "cairn/bayes/particle_filter.hpp"
#include "cairn/localization/global_start.hpp"
#include "cairn/localization/localizer.hpp"
#include "cairn/localization/localizer_options.hpp"
#include "cairn/localization/odometry_buffer.hpp"
#include "cairn/maps/map_set.hpp"
#include "cairn/sensing/stream_info.hpp"

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace cairn {

/// Where a localizer begins: near a pose (T_map_base, spread as InitialOptions say), or anywhere free.
struct Start {
  std::optional<Pose2> T_map_base;
};

/// Monte Carlo localization (Thrun et al., Probabilistic Robotics, table 8.2; with KLD-sampling, table 8.4)
/// on one odometry stream and any number of laser streams.
///
/// A scan waits until odometry around its stamp is known; the motion between two scans is cut exactly there.
/// At most 1000 scans wait: of more, the latest is dropped. The end of the input (finish) uses scans up to
/// 0.5 s after the last odometry where that stood; later ones are dropped.
///
/// What does not fit is dropped and counted: event_check.hpp says what is malformed, odometry_buffer.hpp
/// which odometry stamps are believed. A second scan of one stream with the same stamp is dropped as out of
/// order (a duplicate); so is a scan older than the belief. Where the odometry's clock was set back, the
/// belief stays and the stamps go on from there.
class MonteCarloLocalizer final : public Localizer {
 public:
  using Observer = std::function<void(const Estimate&)>;

  /// @param streams table that Event::stream indexes
  /// @param maps the main one has an occupancy grid
  /// @throws ConfigurationError if the options do not fit the streams or the map, or the start is off the map
  MonteCarloLocalizer(const LocalizerOptions& options, const std::vector<StreamInfo>& streams,
                      const MapLibrary& maps, const Start& start, std::uint64_t seed,
                      std::shared_ptr<const Executor> executor);

  /// Called with the belief at the stamp of every scan that was used or not needed, in the order of the
  /// stamps (unless the clock was set back).
  void set_observer(Observer observer) { observer_ = std::move(observer); }

  Outcome process(const Event& event) override;
  void finish() override;
  std::optional<Estimate> estimate() const override { return estimate_; }
  ParticleSnapshot snapshot(std::size_t at_most) const override;
  const std::vector<OutcomeCounts>& outcomes() const override { return outcomes_; }
  const Diagnostics& diagnostics() const override { return diagnostics_; }
  std::int64_t updates() const override { return updates_; }

 private:
  struct PendingScan {
    StreamId stream;
    std::shared_ptr<const LaserScan> scan;
    std::uint64_t event_number;  ///< of the event that brought it
  };
  /// One stream's sensor model at two widths; both null for a stream that is not bound.
  struct LaserModels {
    std::shared_ptr<const LaserModel> fine;
    std::shared_ptr<const LaserModel> coarse;  ///< while the belief is spread over several places
  };
  using Filter = ParticleFilter<Pose2, Pose2>;

  void bind_streams(const std::vector<StreamInfo>& streams, const MapLibrary& maps);
  void start_near(const Pose2& pose, const GridGeometry& grid);
  void start_anywhere(const BoundUpdate<Pose2>& z);

  Outcome take(const Event& event);
  Outcome take(const Odometry& odometry);
  Outcome take(StreamId stream, const std::shared_ptr<const LaserScan>& scan);
  void use_pending();
  Outcome use(const PendingScan& pending, const Pose2& T_odom_base);
  void decide(const PendingScan& scan, Outcome outcome);
  void settle(StreamId stream, Outcome outcome);
  void settle_held(Outcome outcome);
  void count(StreamId stream, Outcome outcome);
  bool moved_enough(const Pose2& T_last_now) const;
  Estimate summarize(const LaserScan& scan, const LaserModel& model) const;

  LocalizerOptions options_;
  std::optional<StreamId> odometry_stream_;
  std::vector<LaserModels> laser_models_;  ///< per stream
  std::vector<std::string> stream_names_;
  std::shared_ptr<const Executor> executor_;
  Filter filter_;
  std::optional<GlobalStart> global_start_;  ///< until the first scan of a robot that may be anywhere
  Observer observer_;

  OdometryBuffer odometry_;
  std::deque<PendingScan> pending_;  ///< in the order of their stamps
  std::optional<Time> belief_stamp_;
  std::vector<std::optional<Time>> last_used_;  ///< per stream, the stamp of the last scan
  Pose2 T_odom_base_at_update_;                 ///< odometry at the last update
  Estimate at_update_;                          ///< belief right after the last update
  std::optional<Estimate> estimate_;
  std::vector<OutcomeCounts> outcomes_;
  std::uint64_t event_number_ = 0;             ///< of the event in process()
  Outcome event_outcome_ = Outcome::kPending;  ///< what became of it so far
  Diagnostics diagnostics_;
  std::int64_t updates_ = 0;
};

}  // namespace cairn
