#pragma once

#include "cairn/localization/accounts.hpp"
#include "cairn/localization/cost_clock.hpp"
#include "cairn/localization/history.hpp"
#include "cairn/localization/localizer.hpp"
#include "cairn/localization/pose_belief.hpp"
#include "cairn/localization/rewind_forecast.hpp"
#include "cairn/localization/scheduler.hpp"
#include "cairn/localization/stream_binding.hpp"
#include "cairn/localization/synchronizer.hpp"
#include "cairn/localization/watchdog.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cairn {

/// What a FusionLocalizer is made of.
struct FusionParts {
  StreamBindings streams;
  std::unique_ptr<PoseFilter> filter;
  std::unique_ptr<GlobalStart> global_start;  ///< null: the filter is initialised
  GlobalSearch global_search;
  std::unique_ptr<CostClock> cost_clock;
  PoseBelief::Trigger trigger;
  MonitorOptions monitor;
  std::optional<Recovery> recovery = {};  ///< nullopt: a lost robot is not looked for
  TimeOptions time;
  SchedulerOptions scheduler;
  std::shared_ptr<const Executor> executor;
  Diagnostics diagnostics = {};  ///< what whoever made the parts has to warn of
};

/// Any number of sensors, each with its own model, mount, map, rate and delay, and one pose filter: what
/// arrives is put into the order of its stamps, enters the belief there, and is accounted for.
///
///   event -> check -> Synchronizer (order, odometry) -> Scheduler (computing time) -> History (late data)
///         -> PoseBelief (predict, correct)
///
/// What goes wrong with one stream never holds up the others: event_check.hpp says what is malformed,
/// odometry_track.hpp which odometry stamps are believed; a second measurement of one stream with the same
/// stamp is a duplicate. Silent streams are named in diagnostics(). Where a clock was set back, the belief
/// stays and the stamps go on from there. It knows no sensor type. Does not touch the heap in the steady
/// state, apart from what the models and the filter do.
class FusionLocalizer : public Localizer {
 public:
  using Observer = std::function<void(const Estimate&)>;

  explicit FusionLocalizer(FusionParts parts);

  /// Called with the belief at the stamp of every measurement that was used or not needed, in the order of
  /// the stamps (unless the clock was set back). A measurement that comes late is not told by itself: the
  /// belief at the newest measurement is told once more, as it now is.
  void set_observer(Observer observer) { observer_ = std::move(observer); }

  Outcome process(const Event& event) override;
  void finish() override;
  std::optional<Estimate> estimate() const override;
  HypothesisSnapshot hypotheses() const override;
  ParticleSnapshot snapshot(std::size_t at_most) const override;
  const std::vector<OutcomeCounts>& outcomes() const override { return accounts_.table(); }
  const Diagnostics& diagnostics() const override { return diagnostics_; }
  std::int64_t updates() const override { return updates_; }

  /// Number of times that the belief went back for something that came late.
  std::int64_t rewinds() const { return history_.rewinds(); }

 private:
  using Timeline = History<PoseBelief>;

  void tick(const Event& event);
  void watch(const Event& event);
  Outcome take(const Event& event);
  Outcome take_odometry(const Event& event);
  Outcome take_measurement(const Event& event);
  bool belief_is_beyond(const OdometryTrack& odometry) const;
  void clock_set_back(const Odometry& odometry);

  void work();
  void admit();
  void drop_what_is_too_old();
  Scheduler::Candidate candidate_of(const Measurement& measurement) const;
  void use(Measurement&& measurement);
  void catch_up();
  void apply(Timeline::Entry& entry, bool again);
  void charge(const Timeline::Entry& entry, bool again);
  void tell(Time stamp);
  void forget();
  void bound_the_queue();

  void decide(const Measurement& measurement, Outcome outcome);
  void settle(StreamId stream, std::uint64_t number, Outcome from, Outcome to);
  void settle_held(Outcome outcome);
  void warn(const char* kind, const Event& event, const std::string& what);
  Time current_stamp() const;

  std::vector<std::string> stream_names_;
  std::optional<StreamId> odometry_stream_;
  std::vector<Duration> stamp_offsets_;  ///< per stream
  Synchronizer synchronizer_;
  Scheduler scheduler_;
  Watchdog watchdog_;
  Timeline history_;
  RewindForecast forecast_;
  PoseBelief belief_;
  std::unique_ptr<CostClock> cost_clock_;
  Accounts accounts_;
  Diagnostics diagnostics_;
  Observer observer_;

  std::optional<Time> now_;                       ///< newest arrival
  std::vector<Scheduler::Candidate> candidates_;  ///< scratch
  std::vector<std::size_t> queued_;               ///< scratch: deferred measurements per stream
  std::optional<StreamId> late_stream_;  ///< whose late measurement the belief goes back furthest for
  std::optional<Time> told_;             ///< newest stamp that the observer knows
  bool came_late_ = false;               ///< one of those that it goes back for came late
  bool revised_ = false;                 ///< something was applied again since it was told
  bool ended_ = false;
  std::uint64_t event_number_ = 0;             ///< of the event in process()
  Outcome event_outcome_ = Outcome::kPending;  ///< what became of it so far
  std::int64_t updates_ = 0;
};

}  // namespace cairn
