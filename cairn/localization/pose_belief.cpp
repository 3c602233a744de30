#include "cairn/localization/pose_belief.hpp"

#include "cairn/core/angle.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cairn {
namespace {

// Covariance of T * d, with the error of T as it was and d exact: the heading's error moves what is ahead.
Eigen::Matrix3d carried(const Eigen::Matrix3d& covariance, const Pose2& from, const Pose2& to) {
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Identity();
  jacobian(0, 2) = -(to.y - from.y);
  jacobian(1, 2) = to.x - from.x;
  return jacobian * covariance * jacobian.transpose();
}

// Ids of places beside the belief begin here.
constexpr std::uint32_t kFirstRival = 1'000'000;
constexpr double kNegligible = 1e-3;
constexpr double kKnownStart_m = 0.5;  // standard deviation of its position

double apart(const Pose2& a, const Pose2& b) {
  return distance(a, b) + std::abs(normalize_angle(a.theta - b.theta));
}

}  // namespace

PoseBelief::PoseBelief(Parts parts)
    : filter_(std::move(parts.filter)),
      models_(std::move(parts.models)),
      walk_(parts.trigger.walk),
      update_trigger_(make_trigger(parts.trigger.update.trigger())),
      global_start_(std::move(parts.global_start)),
      global_search_(parts.global_search),
      monitor_(parts.monitor),
      recovery_(parts.recovery),
      executor_(std::move(parts.executor)) {
  state_.used_at.resize(models_.size());
  state_.offered.resize(models_.size());
  state_.explained.resize(models_.size());
  state_.looks.resize(models_.size());
  state_.witnesses = Witnesses(models_.size());
  state_.monitor = Monitor::begin(models_.size(), global_start_ != nullptr);
  if (recovery_) state_.recovery = recovery_->begin(global_start_ != nullptr);
}

PoseBelief::Application PoseBelief::apply(const Event& event, const OdometryTrack& odometry,
                                          const Scheduler& scheduler) {
  resolve_anchors(odometry);
  ++state_.offered[event.stream];
  if (!state_.started && !may_begin(*models_[event.stream], event.payload)) return {};
  Application applied;
  const Link link = link_to_last(event, odometry);
  if (recovery_) recovery_->note(state_.recovery, link, event.stamp);
  if (link == Link::kBroken) state_.reckoning.forget();
  if (!state_.started || worth_an_update(event.stream, event.stamp, odometry, scheduler) ||
      link == Link::kBroken || surprises(event, odometry))
    applied = update(event, odometry);
  state_.started = true;
  state_.stamp = event.stamp;
  return applied;
}

// Odometry that came since may tell what was not known then.
void PoseBelief::resolve_anchors(const OdometryTrack& odometry) {
  const auto resolve = [&](OdometryAnchor& anchor) {
    if (!anchor.known) anchor = odometry.anchor_at(anchor.stamp);
  };
  if (state_.started) resolve(state_.updated_at);
  for (auto& anchor : state_.used_at) {
    if (anchor) resolve(*anchor);
  }
  for (auto& look : state_.looks) {
    if (look) resolve(look->at);
  }
}

// Each stream has its own count of the motion: two sensors that look at the same instant are both used.
bool PoseBelief::worth_an_update(StreamId stream, Time stamp, const OdometryTrack& odometry,
                                 const Scheduler& scheduler) const {
  const auto& last = state_.used_at[stream];
  if (!last) return true;
  if (!scheduler.due(stream, last->stamp, stamp)) return false;
  const PoseControl moved = odometry.control(*last, stamp);
  const Pose2& T = moved.T_before_after;
  return update_trigger_->due({.last = last->stamp,
                               .now = stamp,
                               .updates = state_.offered[stream],
                               .translation_m = std::hypot(T.x, T.y) + walk_.sigma_m_after(moved.unknown_s),
                               .rotation_rad = std::abs(T.theta) + walk_.sigma_rad_after(moved.unknown_s)});
}

bool PoseBelief::may_begin(const StreamModel& model, const Event::Payload& z) const {
  return !global_start_ || model.informs(z);
}

// A robot that stands still, and is carried away, would not look at its scans until it moves.
bool PoseBelief::surprises(const Event& event, const OdometryTrack& odometry) const {
  if (!recovery_) return false;
  const StreamModel& model = *models_[event.stream];
  const auto& last = state_.explained[event.stream];
  if (!last || !model.informs(event.payload)) return false;
  const Pose2 now =
      state_.updated.T_map_base * odometry.control(state_.updated_at, event.stamp).T_before_after;
  return recovery_->surprising(*last, model.explained_share(event.payload, now));
}

// Of the last measurement of the same stream, whether an update used it or not.
Link PoseBelief::link_to_last(const Event& event, const OdometryTrack& odometry) {
  const StreamModel& model = *models_[event.stream];
  if (!recovery_ || !model.can_continue() || !model.informs(event.payload)) return Link::kHolds;
  if (!model.can_continue(event.payload)) return others_tell(event.stream) ? Link::kHolds : Link::kUnknown;
  const std::optional<Look> last =
      std::exchange(state_.looks[event.stream], Look{event.payload, odometry.anchor_at(event.stamp)});
  if (!last) return Link::kHolds;
  const PoseControl moved = odometry.control(last->at, event.stamp);
  if (moved.unknown_s > 0.0) return Link::kUnknown;
  return recovery_->link(model.continued_share(last->z, event.payload, moved.T_before_after));
}

// Whether measurements of another stream are compared.
bool PoseBelief::others_tell(StreamId stream) const {
  for (std::size_t i = 0; i < state_.looks.size(); ++i)
    if (i != stream && state_.looks[i]) return true;
  return false;
}

PoseBelief::Application PoseBelief::update(const Event& event, const OdometryTrack& odometry) {
  const StreamModel& model = *models_[event.stream];
  const bool informs = model.informs(event.payload);
  const bool anywhere = !state_.started && global_start_;
  PoseControl moved;
  double since_s = 0.0;
  if (state_.started) {
    moved = odometry.control(state_.updated_at, event.stamp);
    since_s = to_seconds(event.stamp - state_.updated_at.stamp);
  }
  if (anywhere) {
    start_anywhere(event.stream, event.payload);
  } else {
    reckon(moved);
    filter_->predict(moved);
    GlobalSearch::carry(state_.search, moved);
    if (informs) {
      BoundUpdate<Pose2> z = model.bind_given(event.payload, filter_->compact(), [this](std::size_t at_most) {
        return filter_->sample(at_most);
      });
      z.stream = event.stream;
      filter_->correct(z);
    }
  }
  state_.updated_at = odometry.anchor_at(event.stamp);
  state_.used_at[event.stream] = state_.updated_at;
  state_.offered[event.stream] = 0;
  summarize(moved.T_before_after, since_s);
  if (informs && !anywhere) search(model, event);
  const auto seen = judge(model, event, moved.T_before_after);
  recover(model, event, moved.T_before_after, since_s, seen);
  GlobalSearch::temper(state_.search, state_.updated.judgement);
  return {informs, {model.beams(event.payload), static_cast<std::int64_t>(filter_->size())}};
}

// A start pose that was given counts as reckoned if it is known to half a metre; where the odometry was
// silent nothing is.
void PoseBelief::reckon(const PoseControl& moved) {
  if (!state_.started) {
    const PoseSummary start = filter_->summarize();
    if (start.covariance(0, 0) + start.covariance(1, 1) < kKnownStart_m * kKnownStart_m)
      state_.reckoning.begin(start.T_map_base);
  }
  if (moved.unknown_s > 0.0) state_.reckoning.forget();
  state_.reckoning.carry(moved.T_before_after);
}

void PoseBelief::summarize(const Pose2& moved, double since_s) {
  const PoseSummary now = filter_->summarize();
  const PoseHypothesis alone{now.weight, now.T_map_base, now.covariance,
                             static_cast<std::size_t>(now.particles)};
  const auto of_particles = now.places.empty() ? std::span(&alone, 1) : std::span(now.places);
  std::vector<PoseHypothesis> both;
  std::span<const PoseHypothesis> places = of_particles;
  if (state_.search.searching) places = both = GlobalSearch::with_found(state_.search, of_particles);
  const std::uint32_t believed = state_.track.believed();
  follow_hypotheses(places, moved, since_s, {}, state_.track, scratch_);
  if (believed != 0 && state_.track.believed() != believed) {
    Monitor::start_over(state_.monitor);
    state_.reckoning.forget();
  }
  state_.updated.T_map_base = places[0].mean;
  state_.updated.covariance = places[0].covariance;
  state_.updated.ess = now.ess;
  state_.updated.particles = now.particles;
  state_.updated.hypotheses = state_.search.searching ? static_cast<int>(places.size()) : now.hypotheses;
  state_.updated.weight = places[0].weight;
}

// Returns how the beams that tell something stand to the map. Where scans have gone on all the way, those
// that end off the map say nothing: the robot has left what is mapped.
std::optional<BeamShares> PoseBelief::judge(const StreamModel& model, const Event& event,
                                            const Pose2& moved) {
  Estimate& now = state_.updated;
  const Pose2 predicted = state_.pose * moved;
  state_.pose = now.T_map_base;
  now.stamp = event.stamp;
  if (model.informs(event.payload)) {
    now.quality = model.explained_share(event.payload, now.T_map_base);
    state_.explained[event.stream] = now.quality;
  }
  const std::optional<BeamShares> seen = model.classify(event.payload, now.T_map_base);
  const bool tracked = recovery_ && recovery_->well_tracked(state_.recovery);
  const auto telling = seen && tracked ? std::optional(on_the_map(*seen)) : seen;
  now.judgement = monitor_.update(
      state_.monitor,
      {.stream = event.stream,
       .seen = telling,
       .quality = now.quality,
       .places = state_.track.places,
       .innovation_m = state_.started ? apart(predicted, now.T_map_base) : 0.0,
       .drift_m = state_.reckoning.observe(event.stream, model, event.payload, now.T_map_base),
       .share = seen && tracked ? 1.0 - seen->unknown : 1.0,
       .vouched = vouched_by_others(event.stream)});
  if (seen) Monitor::describe(*seen, now.judgement);
  hear(model, event);
  return telling;
}

// Where else a robot may be that is still being looked for.
void PoseBelief::search(const StreamModel& model, const Event& event) {
  if (!global_search_.observe(state_.search, event.stream, model, event.payload, state_.track.places,
                              *filter_))
    return;
  summarize({}, 0.0);
}

// A scanner that its map does not fit speaks against the pose wherever the robot is. While another one
// vouches for it, what this one says is not counted against it; but all count where the robot may have been
// carried away, or is still being looked for.
bool PoseBelief::vouched_by_others(StreamId stream) const {
  return !state_.recovery.carried && !state_.search.searching && state_.witnesses.vouched(stream);
}

// One that is left alone is believed again, whatever others made of it.
void PoseBelief::hear(const StreamModel& model, const Event& event) {
  state_.witnesses.pass();
  if (model.can_continue(event.payload))
    state_.witnesses.hear(event.stream, state_.monitor.last_evidence, state_.updated.judgement.explained);
  if (state_.witnesses.alone(event.stream)) Monitor::believe(state_.monitor, event.stream);
}

// Where a rival wins, it is judged anew by the same scan.
void PoseBelief::recover(const StreamModel& model, const Event& event, const Pose2& moved, double since_s,
                         const std::optional<BeamShares>& seen) {
  if (!recovery_) return;
  RecoveryMemory& memory = state_.recovery;
  const Pose2& believed = state_.updated.T_map_base;
  const double right = monitor_.right_by_scans(state_.monitor);
  const bool fits = Monitor::fits(state_.monitor, event.stream);
  const bool doubtful = recovery_->doubtful(right, seen ? seen->explained : state_.updated.quality,
                                            state_.monitor.streams[event.stream].usual_explained);
  Recovery::carry(memory, moved, since_s);
  if (!doubtful && fits) memory.doubted_m = 0.0;
  if (state_.search.searching) Recovery::unsettle(memory);
  const bool in_doubt = memory.carried || (doubtful && !recovery_->anchored(memory));
  if (model.informs(event.payload) && fits)
    recovery_->observe(memory, event.stream, model, event.payload, believed, in_doubt);
  const StreamModel& of_glimpses = memory.glimpses.empty() ? model : *models_[memory.stream];
  recovery_->search(memory, of_glimpses, event.stamp, believed);
  const bool vouched = vouched_by_others(event.stream) || !fits;
  const Standing standing = recovery_->standing(right, vouched ? std::nullopt : seen);
  // Nothing that a search has not confirmed is trusted against a rival, however well the map explains it.
  const Standing against =
      state_.search.searching && standing == Standing::kTrusted ? Standing::kDoubtful : standing;
  const bool elsewhere = recovery_->take_over(memory, state_.track.places, against, *filter_);
  if (elsewhere) {
    summarize({}, 0.0);
    Monitor::take_over(state_.monitor);
    state_.reckoning.forget();
    state_.pose = state_.updated.T_map_base;
    judge(model, event, {});
  }
  judge_by_rivals(standing == Standing::kTrusted && !elsewhere);
  recovery_->settle(memory, right, standing, vouched);
}

// What the rivals leave of the belief. A pose that nothing else speaks against is called ambiguous by them,
// not lost: with so many beams the best of all places on the map fits one scan well, wherever the robot is.
void PoseBelief::judge_by_rivals(bool trusted) {
  Judgement& judgement = state_.updated.judgement;
  const double share = Rivals::believed_share(state_.recovery.rivals);
  judgement.probability = state_.updated.weight * monitor_.right(state_.monitor) * share;
  if (state_.recovery.carried) judgement.probability *= GlobalSearch::kMostUnconfirmed;
  if (judgement.state == TrackingState::kSensorFault) return;
  if (monitor_.right_by_scans(state_.monitor) * share < 0.5 && !trusted) {
    judgement.state = TrackingState::kLost;
  } else if (share < 0.9 && judgement.state != TrackingState::kLost) {
    judgement.state = TrackingState::kAmbiguous;
  }
}

// The first measurement of a robot that may be anywhere makes the first particles; it must not weigh them
// once more.
void PoseBelief::start_anywhere(StreamId stream, const Event::Payload& z) {
  const StreamModel& model = *models_[stream];
  global_start_->weigh(model.bind(z, false), *executor_);
  global_start_->add_modes(global_search_.begin(state_.search, stream, model, z));
  filter_->initialize(
      [&](const RandomStream& random, std::uint32_t i) { return global_start_->sample(random, i); });
}

Estimate PoseBelief::estimate_at(Time stamp, const OdometryTrack& odometry) const {
  Estimate estimate = state_.updated;
  const OdometryAnchor now = odometry.anchor_at(stamp);
  estimate.T_map_base = state_.updated.T_map_base * odometry.control(state_.updated_at, stamp).T_before_after;
  estimate.covariance = carried(estimate.covariance, state_.updated.T_map_base, estimate.T_map_base);
  estimate.stamp = stamp;
  estimate.belief_stamp = state_.stamp;
  estimate.T_map_odom = estimate.T_map_base * inverse(now.T_odom_base);
  return estimate;
}

HypothesisSnapshot PoseBelief::hypotheses_at(Time stamp, const OdometryTrack& odometry) const {
  HypothesisSnapshot snapshot{stamp, state_.track.places};
  const Pose2 T_then_now = odometry.control(state_.updated_at, stamp).T_before_after;
  for (Hypothesis& place : snapshot.hypotheses) {
    const Pose2 then = place.T_map_base;
    place.T_map_base = then * T_then_now;
    place.covariance = carried(place.covariance, then, place.T_map_base);
    place.age_s += to_seconds(stamp - state_.updated.stamp);
  }
  add_rivals(T_then_now, to_seconds(stamp - state_.updated.stamp), snapshot);
  return snapshot;
}

// The belief's places keep the share that the rivals leave them.
void PoseBelief::add_rivals(const Pose2& T_then_now, double since_s, HypothesisSnapshot& snapshot) const {
  const std::vector<Rival>& rivals = state_.recovery.rivals;
  if (rivals.empty()) return;
  const double share = Rivals::believed_share(rivals);
  for (Hypothesis& place : snapshot.hypotheses) place.weight *= share;
  for (const Rival& rival : rivals) {
    const double weight = Rivals::share(rivals, rival.log_odds);
    if (weight < kNegligible) continue;
    snapshot.hypotheses.push_back({rival.T_map_base * T_then_now, Recovery::spread(), weight,
                                   rival.age_s + since_s, kFirstRival + rival.id});
  }
}

ParticleSnapshot PoseBelief::snapshot_at(Time stamp, std::size_t at_most,
                                         const OdometryTrack& odometry) const {
  ParticleSnapshot snapshot{stamp, filter_->sample(at_most)};
  const Pose2 T_then_now = odometry.control(state_.updated_at, stamp).T_before_after;
  for (Pose2& pose : snapshot.particles) pose = pose * T_then_now;
  return snapshot;
}

void PoseBelief::save(Checkpoint& checkpoint) const {
  checkpoint.state = state_;
  if (!checkpoint.filter) checkpoint.filter = filter_->new_checkpoint();
  filter_->save(*checkpoint.filter);
}

void PoseBelief::restore(const Checkpoint& checkpoint) {
  state_ = checkpoint.state;
  filter_->restore(*checkpoint.filter);
}

}  // namespace cairn
