#include "cairn/localization/fusion_localizer.hpp"

#include "cairn/localization/event_check.hpp"

#include <algorithm>
#include <utility>

namespace cairn {
namespace {

constexpr Duration kClockSetBack = std::chrono::seconds(10);
// What is dear to do again is used at once, all the same, where the belief would fall further behind.
constexpr Duration kMostBehind = std::chrono::milliseconds(200);

Duration history_of(const TimeOptions& options) {
  return options.late_policy == "replay" ? duration_from_seconds(options.history_s) : Duration{0};
}

}  // namespace

FusionLocalizer::FusionLocalizer(FusionParts parts)
    : stream_names_(std::move(parts.streams.names)),
      odometry_stream_(parts.streams.odometry),
      stamp_offsets_(std::move(parts.streams.stamp_offsets)),
      synchronizer_(parts.time, stream_names_.size()),
      scheduler_(parts.scheduler, std::move(parts.streams.shares)),
      watchdog_(std::move(parts.streams.periods), parts.time.watchdog_factor),
      history_(history_of(parts.time)),
      belief_({std::move(parts.filter), std::move(parts.streams.models), parts.trigger,
               std::move(parts.global_start), parts.global_search, Monitor(parts.monitor), parts.recovery,
               std::move(parts.executor)}),
      cost_clock_(std::move(parts.cost_clock)),
      accounts_(stream_names_.size()),
      diagnostics_(std::move(parts.diagnostics)),
      queued_(stream_names_.size()) {}

Outcome FusionLocalizer::process(const Event& event) {
  if (event.stream >= stream_names_.size()) {
    diagnostics_.warn("event of an unknown stream", "stream " + std::to_string(event.stream),
                      "the table has " + std::to_string(stream_names_.size()) + " streams");
    return Outcome::kDroppedUnboundStream;
  }
  ++event_number_;
  event_outcome_ = take(event);
  accounts_.open(event.stream, event_outcome_);
  work();
  return event_outcome_;
}

Outcome FusionLocalizer::take(const Event& event) {
  const bool odometry = std::holds_alternative<Odometry>(event.payload);
  const bool bound = odometry ? event.stream == odometry_stream_ : belief_.binds(event);
  if (!bound) return Outcome::kDroppedUnboundStream;
  if (const char* what = defect(event)) {
    warn(odometry ? "malformed odometry" : "malformed scan", event, what);
    return Outcome::kDroppedMalformed;
  }
  tick(event);
  return odometry ? take_odometry(event) : take_measurement(event);
}

// The clock of the arrivals is the time by which waiting is measured. Where it was set back, what was put
// behind the present while it was wrong must not make stale what comes now.
void FusionLocalizer::tick(const Event& event) {
  if (now_ && event.arrival < *now_ - kClockSetBack) {
    synchronizer_.restart_clock(event.arrival);
    watchdog_.restart(event.arrival);
    history_.restart();
    forecast_.clear();
    told_.reset();
    warn("arrival clock set back", event, "it arrived more than 10 s before earlier ones");
    now_ = event.arrival;
  }
  now_ = std::max(now_.value_or(event.arrival), event.arrival);
  synchronizer_.observe(event, *now_);
  scheduler_.advance(*now_);
  watch(event);
}

void FusionLocalizer::watch(const Event& event) {
  watchdog_.heard(event.stream, *now_);
  watchdog_.look(*now_, [&](StreamId stream, Time since, Duration period) {
    diagnostics_.warn("silent stream", "stream " + stream_names_[stream],
                      "nothing arrived after " + format_time(since) + " s; it used to speak every " +
                          std::to_string(to_seconds(period)) + " s");
  });
}

Outcome FusionLocalizer::take_odometry(const Event& event) {
  const auto& odometry = std::get<Odometry>(event.payload);
  const OdometryTrack::Intake intake = synchronizer_.add(odometry, *now_);
  if (intake.held) settle_held(*intake.held);
  if (intake.set_back) clock_set_back(odometry);
  if (intake.changed_after) history_.redo_after(*intake.changed_after);
  if (belief_is_beyond(synchronizer_.odometry())) clock_set_back(odometry);
  return intake.now;
}

Outcome FusionLocalizer::take_measurement(const Event& event) {
  const TimelineKey key{event.stamp + stamp_offsets_[event.stream], event.stream};
  if (synchronizer_.waits(key) || history_.contains(key)) {
    warn("duplicate scan", event, "there is one with this stamp");
    return Outcome::kDroppedDuplicate;
  }
  if (history_.is_stale(key.stamp)) return Outcome::kDroppedStale;
  Measurement measurement{event, event_number_, false};
  measurement.event.stamp = key.stamp;
  measurement.came_late = belief_.started() && key.stamp < belief_.stamp();
  synchronizer_.add(std::move(measurement));
  return Outcome::kPending;
}

// Measurements alone, with wrong stamps and no odometry, may have led the belief into the future.
bool FusionLocalizer::belief_is_beyond(const OdometryTrack& odometry) const {
  return !history_.empty() && !odometry.empty() &&
         belief_.stamp() - odometry.newest().stamp > OdometryTrack::kLargestJump;
}

void FusionLocalizer::clock_set_back(const Odometry& odometry) {
  diagnostics_.warn("clock set back", "odometry at " + format_time(odometry.stamp) + " s",
                    "the stamps go on from here");
  history_.restart();
  synchronizer_.restart_clock(*now_);
  told_.reset();
}

void FusionLocalizer::work() {
  admit();
  catch_up();
  bound_the_queue();
}

void FusionLocalizer::admit() {
  if (scheduler_.limited()) drop_what_is_too_old();
  const std::size_t ready = synchronizer_.ready();
  candidates_.clear();
  for (std::size_t i = 0; i < ready; ++i) candidates_.push_back(candidate_of(synchronizer_.waiting()[i]));
  if (!ended_) scheduler_.admit(candidates_);
  synchronizer_.take(candidates_, [&](Measurement&& measurement) { use(std::move(measurement)); });
}

// What waited for computing time until the history no longer reaches it must not be paid for any more.
void FusionLocalizer::drop_what_is_too_old() {
  const auto& waiting = synchronizer_.waiting();
  while (!waiting.empty() && waiting[0].deferred && history_.is_stale(waiting[0].event.stamp)) {
    decide(synchronizer_.remove(0), Outcome::kDroppedOverBudget);
  }
}

Scheduler::Candidate FusionLocalizer::candidate_of(const Measurement& measurement) const {
  Scheduler::Candidate candidate{measurement.event.stream, ended_};
  if (!scheduler_.limited() || !belief_.started()) return candidate;
  const Duration age = belief_.stamp() - measurement.event.stamp;
  candidate.redo_s = to_seconds(history_.redo_cost(key_of(measurement)));
  if (-age < kMostBehind && !measurement.came_late) candidate.redos = forecast_.redos(age, *now_);
  candidate.rides = !measurement.came_late && forecast_.redos(Duration{0}, *now_) > 0.0;
  return candidate;
}

void FusionLocalizer::use(Measurement&& measurement) {
  const Time stamp = measurement.event.stamp;
  if (history_.is_stale(stamp)) {
    decide(measurement, measurement.deferred ? Outcome::kDroppedOverBudget : Outcome::kDroppedStale);
    return;
  }
  const bool late = belief_.started() && stamp < belief_.stamp();
  came_late_ |= late && measurement.came_late;
  if (late && !late_stream_) late_stream_ = measurement.event.stream;  // the earliest comes first
  history_.insert(std::move(measurement));
}

void FusionLocalizer::catch_up() {
  const Duration depth =
      history_.catch_up(belief_, [&](Timeline::Entry& entry, bool again) { apply(entry, again); });
  if (came_late_) forecast_.went_back(depth, *now_);
  came_late_ = false;
  if (revised_ && belief_.started()) tell(belief_.stamp());
  revised_ = false;
  late_stream_.reset();
  forget();
}

void FusionLocalizer::apply(Timeline::Entry& entry, bool again) {
  const Event& event = entry.measurement.event;
  cost_clock_->start();
  const auto applied = belief_.apply(event, synchronizer_.odometry(), scheduler_);
  entry.cost = applied.used ? cost_clock_->stop(applied.work) : Duration{0};
  charge(entry, again);
  const Outcome use = entry.measurement.deferred ? Outcome::kDeferred
                      : entry.late               ? Outcome::kReplayed
                                                 : Outcome::kUsed;
  const Outcome outcome = applied.used ? use : Outcome::kNotNeeded;
  settle(event.stream, entry.measurement.number, entry.outcome, outcome);
  entry.outcome = outcome;
  if (!belief_.started()) return;
  if (again || (told_ && event.stamp < *told_)) {
    revised_ = true;
  } else {
    tell(event.stamp);
  }
}

// What is done again is paid for by the stream that came late.
void FusionLocalizer::charge(const Timeline::Entry& entry, bool again) {
  if (entry.cost == Duration{0}) return;
  const StreamId own = entry.measurement.event.stream;
  again ? scheduler_.charge_redo(late_stream_.value_or(own), entry.cost) : scheduler_.charge(own, entry.cost);
}

void FusionLocalizer::tell(Time stamp) {
  told_ = stamp;
  revised_ = false;
  if (observer_) observer_(belief_.estimate_at(stamp, synchronizer_.odometry()));
}

// A late odometry message changes the motion from the one before it on: as far back as measurements can be
// put, the odometry around them is kept, and as far back as odometry is kept, so are the measurements; but
// twice the history is the most that is ever done again.
void FusionLocalizer::forget() {
  if (history_.empty()) return;
  OdometryTrack& odometry = synchronizer_.odometry();
  Time from = history_.wanted_from();
  if (!odometry.empty()) from = std::clamp(odometry.at_or_before(from), from - history_.span(), from);
  history_.forget_before(from);
  odometry.forget_before(from);
  if (history_.oldest() == nullptr || history_.oldest()->started()) belief_.forget_start();
}

// Where too many wait for odometry, the latest goes: one from the future must not push out those that can
// still be used. Of those that wait for computing time, it is the oldest of the stream.
void FusionLocalizer::bound_the_queue() {
  const auto& waiting = synchronizer_.waiting();
  if (waiting.size() > Synchronizer::kMostWaiting) {
    decide(synchronizer_.remove(waiting.size() - 1), Outcome::kDroppedNoOdometry);
  }
  if (!scheduler_.limited()) return;
  std::fill(queued_.begin(), queued_.end(), 0);
  for (std::size_t i = waiting.size(); i-- > 0;) {
    const Measurement& measurement = waiting[i];
    if (!measurement.deferred || ++queued_[measurement.event.stream] <= scheduler_.queue()) continue;
    decide(synchronizer_.remove(i), Outcome::kDroppedOverBudget);
  }
}

void FusionLocalizer::finish() {
  if (synchronizer_.odometry().drop_held()) settle_held(Outcome::kDroppedOutOfOrder);
  ended_ = true;
  synchronizer_.end();
  work();
  while (!synchronizer_.waiting().empty()) decide(synchronizer_.remove(0), Outcome::kDroppedNoOdometry);
}

std::optional<Estimate> FusionLocalizer::estimate() const {
  if (!belief_.started()) return std::nullopt;
  return belief_.estimate_at(current_stamp(), synchronizer_.odometry());
}

Time FusionLocalizer::current_stamp() const {
  const OdometryTrack& odometry = synchronizer_.odometry();
  return odometry.empty() ? belief_.stamp() : std::max(belief_.stamp(), odometry.newest().stamp);
}

HypothesisSnapshot FusionLocalizer::hypotheses() const {
  if (!belief_.started()) return {};
  return belief_.hypotheses_at(current_stamp(), synchronizer_.odometry());
}

ParticleSnapshot FusionLocalizer::snapshot(std::size_t at_most) const {
  if (!belief_.started()) return {};
  return belief_.snapshot_at(current_stamp(), at_most, synchronizer_.odometry());
}

void FusionLocalizer::decide(const Measurement& measurement, Outcome outcome) {
  settle(measurement.event.stream, measurement.number, Outcome::kPending, outcome);
}

void FusionLocalizer::settle(StreamId stream, std::uint64_t number, Outcome from, Outcome to) {
  accounts_.move(stream, from, to);
  updates_ += (is_use(to) ? 1 : 0) - (is_use(from) ? 1 : 0);
  if (number == event_number_) event_outcome_ = to;
}

void FusionLocalizer::settle_held(Outcome outcome) {
  accounts_.move(*odometry_stream_, Outcome::kPending, outcome);
  if (outcome == Outcome::kUsed) return;
  diagnostics_.warn("odometry stamp not believed",
                    "odometry after " + format_time(synchronizer_.odometry().newest().stamp) + " s",
                    "its stamp jumps by more than 10 s, and the next message does not follow it");
}

void FusionLocalizer::warn(const char* kind, const Event& event, const std::string& what) {
  diagnostics_.warn(kind, "stream " + stream_names_[event.stream] + " at " + format_time(event.stamp) + " s",
                    what);
}

}  // namespace cairn
