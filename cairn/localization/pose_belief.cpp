#include "cairn/localization/pose_belief.hpp"

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

}  // namespace

PoseBelief::PoseBelief(std::unique_ptr<PoseFilter> filter,
                       std::vector<std::unique_ptr<const StreamModel>> models, const Trigger& trigger,
                       std::unique_ptr<GlobalStart> global_start, std::shared_ptr<const Executor> executor)
    : filter_(std::move(filter)),
      models_(std::move(models)),
      walk_(trigger.walk),
      update_trigger_(make_trigger(trigger.update.trigger())),
      global_start_(std::move(global_start)),
      executor_(std::move(executor)) {
  state_.used_at.resize(models_.size());
  state_.offered.resize(models_.size());
}

PoseBelief::Application PoseBelief::apply(const Event& event, const OdometryTrack& odometry,
                                          const Scheduler& scheduler) {
  resolve_anchors(odometry);
  ++state_.offered[event.stream];
  if (!state_.started && !may_begin(*models_[event.stream], event.payload)) return {};
  Application applied;
  if (!state_.started || worth_an_update(event.stream, event.stamp, odometry, scheduler))
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

PoseBelief::Application PoseBelief::update(const Event& event, const OdometryTrack& odometry) {
  const StreamModel& model = *models_[event.stream];
  const bool informs = model.informs(event.payload);
  const bool anywhere = !state_.started && global_start_;
  if (anywhere) {
    start_anywhere(model, event.payload);
  } else {
    filter_->predict(state_.started ? odometry.control(state_.updated_at, event.stamp) : PoseControl{});
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
  const PoseSummary now = filter_->summarize();
  state_.updated = {
      .stamp = event.stamp,
      .T_map_base = now.T_map_base,
      .covariance = now.covariance,
      .ess = now.ess,
      .particles = now.particles,
      .hypotheses = now.hypotheses,
      .weight = now.weight,
      .quality = informs ? model.explained_share(event.payload, now.T_map_base) : state_.updated.quality};
  return {informs, {model.beams(event.payload), static_cast<std::int64_t>(filter_->size())}};
}

// The first measurement of a robot that may be anywhere makes the first particles; it must not weigh them
// once more.
void PoseBelief::start_anywhere(const StreamModel& model, const Event::Payload& z) {
  global_start_->weigh(model.bind(z, false), *executor_);
  global_start_->add_modes(model.locate(z));
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
