#pragma once

#include "cairn/core/executor.hpp"
#include "cairn/localization/cost_clock.hpp"
#include "cairn/localization/estimate.hpp"
#include "cairn/localization/global_search.hpp"
#include "cairn/localization/global_start.hpp"
#include "cairn/localization/hypothesis_track.hpp"
#include "cairn/localization/localizer_options.hpp"
#include "cairn/localization/monitor.hpp"
#include "cairn/localization/odometry_track.hpp"
#include "cairn/localization/pose_filter.hpp"
#include "cairn/localization/reckoning.hpp"
#include "cairn/localization/recovery.hpp"
#include "cairn/localization/scheduler.hpp"
#include "cairn/localization/stream_model.hpp"
#include "cairn/localization/witnesses.hpp"

#include <memory>
#include <optional>
#include <vector>

namespace cairn {

/// What a localizer believes, and how a measurement changes it: the part of a localizer that History takes
/// back in time. What it becomes is a function of the measurements in the order in which they are applied
/// and of the odometry around them; it knows nothing of their arrival.
class PoseBelief {
 public:
  /// When a measurement of a stream is worth an update.
  struct Trigger {
    UpdateOptions update;
    RandomWalkOptions walk;  ///< counts as motion where there is no odometry
  };

  /// What a belief is made of.
  struct Parts {
    std::unique_ptr<PoseFilter> filter;
    std::vector<std::unique_ptr<const StreamModel>> models;  ///< per stream; null: the stream is not bound
    Trigger trigger;
    /// Null: the filter is initialised; else the first measurement does that.
    std::unique_ptr<GlobalStart> global_start;
    GlobalSearch global_search;  ///< after a global start
    Monitor monitor;
    std::optional<Recovery> recovery;  ///< nullopt: a lost robot is not looked for
    std::shared_ptr<const Executor> executor;
  };
  explicit PoseBelief(Parts parts);

  bool binds(const Event& event) const {
    const auto& model = models_[event.stream];
    return model != nullptr && model->kind() == kind_of(event);
  }

  /// What applying a measurement came to.
  struct Application {
    bool used = false;  ///< it weighed the belief
    UpdateWork work;
  };
  /// Takes the belief to the measurement's stamp and, if it is worth it, weighs it. A measurement that does
  /// not inform only carries the belief on; it cannot begin one that may be anywhere.
  /// @pre binds(event)
  Application apply(const Event& event, const OdometryTrack& odometry, const Scheduler& scheduler);

  bool started() const { return state_.started; }
  /// Stamp of the newest measurement. @pre started()
  Time stamp() const { return state_.stamp; }
  /// The belief, carried by the odometry to `stamp`. @pre started()
  Estimate estimate_at(Time stamp, const OdometryTrack& odometry) const;
  /// The places of the belief, carried likewise.
  HypothesisSnapshot hypotheses_at(Time stamp, const OdometryTrack& odometry) const;
  /// A sample of the belief, carried likewise.
  ParticleSnapshot snapshot_at(Time stamp, std::size_t at_most, const OdometryTrack& odometry) const;

  /// Frees what only the beginning needs. @pre nobody will go back to before it
  void forget_start() { global_start_.reset(); }

 private:
  struct Look {
    Event::Payload z;
    OdometryAnchor at;
  };
  struct State {
    bool started = false;
    Time stamp;
    OdometryAnchor updated_at;                           ///< of the last update
    Estimate updated;                                    ///< the belief right after it
    std::vector<std::optional<OdometryAnchor>> used_at;  ///< per stream, its last measurement that was used
    std::vector<std::int64_t> offered;                   ///< per stream, how many came since
    std::vector<std::optional<double>> explained;        ///< per stream, share of it that the map explained
    std::vector<std::optional<Look>> looks;              ///< per stream, its last measurement
    Witnesses witnesses;
    HypothesisTrack track;
    Pose2 pose;  ///< of the last update, for the innovation
    Reckoning reckoning;
    MonitorMemory monitor;
    RecoveryMemory recovery;
    GlobalSearchMemory search;
  };

 public:
  /// All that changes in a belief.
  struct Checkpoint {
    bool started() const { return state.started; }
    State state;
    std::unique_ptr<PoseFilter::Checkpoint> filter;
  };
  void save(Checkpoint& checkpoint) const;
  void restore(const Checkpoint& checkpoint);

 private:
  void resolve_anchors(const OdometryTrack& odometry);
  bool worth_an_update(StreamId stream, Time stamp, const OdometryTrack& odometry,
                       const Scheduler& scheduler) const;
  void start_anywhere(StreamId stream, const Event::Payload& z);
  bool may_begin(const StreamModel& model, const Event::Payload& z) const;
  Application update(const Event& event, const OdometryTrack& odometry);
  void reckon(const PoseControl& moved);
  void summarize(const Pose2& moved, double since_s);
  std::optional<BeamShares> judge(const StreamModel& model, const Event& event, const Pose2& moved);
  void recover(const StreamModel& model, const Event& event, const Pose2& moved, double since_s,
               const std::optional<BeamShares>& seen);
  bool vouched_by_others(StreamId stream) const;
  void hear(const StreamModel& model, const Event& event);
  void judge_by_rivals(bool trusted);
  bool surprises(const Event& event, const OdometryTrack& odometry) const;
  Link link_to_last(const Event& event, const OdometryTrack& odometry);
  bool others_tell(StreamId stream) const;
  void add_rivals(const Pose2& T_then_now, double since_s, HypothesisSnapshot& snapshot) const;
  void search(const StreamModel& model, const Event& event);

  std::unique_ptr<PoseFilter> filter_;
  std::vector<std::unique_ptr<const StreamModel>> models_;
  RandomWalkOptions walk_;
  std::unique_ptr<const cairn::Trigger> update_trigger_;
  std::unique_ptr<GlobalStart> global_start_;
  GlobalSearch global_search_;
  Monitor monitor_;
  std::optional<Recovery> recovery_;
  std::shared_ptr<const Executor> executor_;
  State state_;
  std::vector<Hypothesis> scratch_;
};

}  // namespace cairn
