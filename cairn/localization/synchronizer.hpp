#pragma once

#include "cairn/localization/lag_estimator.hpp"
#include "cairn/localization/measurement.hpp"
#include "cairn/localization/odometry_track.hpp"
#include "cairn/localization/scheduler.hpp"
#include "cairn/localization/sliding_vector.hpp"
#include "cairn/localization/time_options.hpp"

#include <optional>
#include <span>
#include <utility>

namespace cairn {

/// Puts what arrives into the order of its stamps, and tells when which measurement may enter the belief:
/// once the odometry around its stamp is known, so that the motion can be cut exactly there.
///
/// Nothing waits for ever. Where the odometry has been silent for `odometry_timeout_s` and kSilentAfter other
/// messages (one wrong arrival must not pass for a silence), measurements go on without it as soon as their
/// stamp lies in the past, which the last odometry and the time since then tell (where there never was any,
/// the shortest lag of all streams): one with a stamp from the future waits without holding up others. Under
/// late_policy delay all wait, besides, until the most delayed stream has had its say. At most kMostWaiting
/// wait.
class Synchronizer {
 public:
  static constexpr std::size_t kMostWaiting = 1000;
  static constexpr int kSilentAfter = 5;
  /// At the end of the input, measurements up to this time after the last odometry are still used.
  static constexpr Duration kExtrapolation = std::chrono::milliseconds(500);

  Synchronizer(const TimeOptions& options, std::size_t streams);

  /// Time went on to `now`, the arrival of `event`, whose stamp tells the lag of its stream.
  void observe(const Event& event, Time now);

  OdometryTrack::Intake add(const Odometry& odometry, Time now);
  /// @pre !waits(key_of(measurement))
  void add(Measurement measurement);
  bool waits(const TimelineKey& key) const;

  /// Number of waiting measurements that may be used now: the first so many.
  std::size_t ready() const;
  const SlidingVector<Measurement>& waiting() const { return waiting_; }

  /// Hands out the first measurements, those that are admitted; the others among them are marked as deferred
  /// and stay. @param choice per measurement, at most ready()
  template <class Use>
  void take(std::span<const Scheduler::Candidate> choice, const Use& use) {
    for (std::size_t i = 0; i < choice.size(); ++i) {
      if (choice[i].admitted) {
        use(std::move(waiting_[i]));
      } else {
        waiting_[i].deferred = true;
      }
    }
    std::size_t i = 0;
    waiting_.retain([&](const Measurement&) { return i >= choice.size() || !choice[i++].admitted; });
  }

  /// Takes the measurement at `index` out of the queue.
  Measurement remove(std::size_t index);

  bool odometry_is_silent() const;
  /// After the last event: nothing is waited for any more.
  void end() { ended_ = true; }
  /// The clock of the arrivals was set back to `now`.
  void restart_clock(Time now);

  const OdometryTrack& odometry() const { return odometry_; }
  OdometryTrack& odometry() { return odometry_; }
  const LagEstimator& lags() const { return lags_; }

 private:
  std::size_t place_of(const TimelineKey& key) const;
  Time ready_until() const;
  std::optional<Time> present() const;

  bool delays_;
  Duration odometry_timeout_;
  LagEstimator lags_;
  OdometryTrack odometry_;
  SlidingVector<Measurement> waiting_;  ///< in the order of their keys
  Time now_;
  std::optional<Time> heard_odometry_;  ///< arrival of the last one; of the first event before there was one
  int others_ = 0;                      ///< messages since then
  bool ended_ = false;
};

}  // namespace cairn
