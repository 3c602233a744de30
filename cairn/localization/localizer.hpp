#pragma once

#include "cairn/core/diagnostics.hpp"
#include "cairn/localization/estimate.hpp"
#include "cairn/sensing/event.hpp"

#include <optional>

namespace cairn {

/// The one run-time interface of everything that tells a robot where it is: the evaluator, the bridges and
/// the command line know no other.
///
/// A localizer is a pure, single-threaded, event-driven object: the same events, configuration and seed give
/// the same bytes, for any number of threads that it was given. It never throws on an event and reads no
/// clock but the one that it may be given for the cost of updates.
class Localizer {
 public:
  virtual ~Localizer() = default;

  /// Takes the next event, in the order of arrival. Returns what became of it; kPending if that is decided by
  /// a later event (a scan that waits for the odometry after it). What was decided may change when something
  /// arrives late: outcomes() tells how things stand. An event of a stream beyond the table has
  /// no row in outcomes(): it is dropped (kDroppedUnboundStream) and counted in diagnostics() as "event of an
  /// unknown stream".
  virtual Outcome process(const Event& event) = 0;

  /// Ends the input: decides what is still pending.
  virtual void finish() = 0;

  /// The belief, current: that of the newest measurement, carried on by the newest odometry. nullopt before
  /// the first measurement.
  virtual std::optional<Estimate> estimate() const = 0;

  /// The separate places that the current belief holds, the reported pose first, each with its own mean and
  /// covariance: at the instant of estimate(). Empty before the first measurement.
  virtual HypothesisSnapshot hypotheses() const = 0;

  /// Sample of at most `at_most` particles of the current belief, for pictures.
  virtual ParticleSnapshot snapshot(std::size_t at_most) const = 0;

  /// Final outcomes per stream; with kPending, their sum is the number of events processed of the streams
  /// in the table.
  virtual const std::vector<OutcomeCounts>& outcomes() const = 0;
  virtual const Diagnostics& diagnostics() const = 0;

  /// Number of measurements that weighed the belief.
  virtual std::int64_t updates() const = 0;
};

}  // namespace cairn
