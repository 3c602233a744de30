#pragma once

#include "cairn/core/options.hpp"
#include "cairn/sensing/event.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cairn {

struct SchedulerOptions {
  std::string policy = "all";  ///< all, rate or cfs
  double rate_hz = 5.0;        ///< policy rate: updates per second and stream
  double compute_share = 0.0;  ///< seconds of computing per second, 0..; 0: no limit
  int queue = 16;              ///< measurements per stream that may wait for computing time
  double cost_ns = 10.0;       ///< of one beam in one particle, where costs are modelled

  void visit(OptionVisitor& visitor);
};

/// Decides which of the measurements that could be used now are: computing time is limited, and models differ
/// in cost by orders of magnitude.
///   all   in the order of their stamps
///   rate  as all; besides, each stream is used at most so often per second of its stamps (see due)
///   cfs   completely fair (MuSe, section III-E, after the scheduler of Linux): the stream with the least
///         virtual time is next, and of its measurements the newest; what it costs is added to its virtual
///         time, times the stream's `nice` value. A stream that had nothing to do starts level with the
///         others, so that it cannot save up time.
/// What is not admitted waits; nothing is lost here. The credit of computing time grows by `compute_share`
/// per second, up to that of one second, and falls by what the updates cost.
///
/// Under cfs an update has to be paid for before it is made: a dear one must not put the others off until its
/// debt is paid. While its stream saves up for it, the others go on as far as if it had been made. The price
/// of a measurement that comes late is that of all that has to be done again for it, but those of a stream go
/// back together, for the price of the earliest that asks for no more than half of the largest credit. What
/// is used before late data of its time has come will be done again with that: such work may take half of the
/// computing time, lest the dear models are done over and over; what goes beyond waits until it is older than
/// the late data, and is then used once.
class Scheduler {
 public:
  struct Candidate {
    StreamId stream = 0;
    bool admitted = false;
    double redo_s = 0.0;  ///< computing time of all that has to be done again if this is put in
    double redos = 0.0;   ///< how often it is itself expected to be done again (RewindForecast)
    bool rides = false;   ///< the belief will go back for others anyhow: it need not for this one
  };
  /// What a stream may want to differ in.
  struct Share {
    double nice = 1.0;              ///< virtual time per time; lower: more often
    std::optional<double> rate_hz;  ///< in place of SchedulerOptions::rate_hz
  };

  Scheduler(const SchedulerOptions& options, std::vector<Share> shares);

  /// Time went on to `now` (arrival); a step back earns nothing.
  void advance(Time now);

  /// Marks what may be used now. What rides is not put in where that costs more than itself again. @param
  /// waiting in the order of the stamps, all at first not admitted
  void admit(std::span<Candidate> waiting);

  /// An update of `stream` had this cost.
  void charge(StreamId stream, Duration cost);
  /// Computing time for what was done again because `stream` came late.
  void charge_redo(StreamId stream, Duration cost);

  /// Policy rate: whether a measurement is far enough from the last one of its stream that was used.
  bool due(StreamId stream, std::optional<Time> last_used, Time stamp) const;

  /// What is not admitted is put off, not past this number per stream.
  std::size_t queue() const { return static_cast<std::size_t>(options_.queue); }
  bool limited() const { return options_.compute_share > 0.0; }

  double virtual_time_s(StreamId stream) const { return streams_[stream].virtual_s; }
  double credit_s() const { return credit_s_; }

 private:
  struct Stream {
    Share share;
    double virtual_s = 0.0;
    double cost_s = 0.0;  ///< what an update costs, exponential average
    bool waiting = false;
    double planned_s = 0.0;  ///< virtual time if what was admitted costs what is expected
    bool saving = false;     ///< the credit does not cover what it wants next
  };

  struct Plan {
    double credit_s = 0.0;
    double redo_s = 0.0;  ///< of the earliest measurement that was admitted
  };
  struct Together {
    Candidate* first = nullptr;
    double price_s = 0.0;
  };

  void wake(std::span<const Candidate> waiting);
  void admit_oldest(std::span<Candidate> waiting);
  void admit_fairly(std::span<Candidate> waiting);
  Candidate* fairest(std::span<Candidate> waiting, const Plan& plan);
  Together all_late(StreamId stream, std::span<Candidate> waiting) const;
  bool plenty() const;
  bool makes_sense(const Candidate& candidate, const Plan& plan) const;
  double price_s(const Candidate& candidate, const Plan& plan) const;
  void serve(Candidate& candidate, Plan& plan);
  void pay(StreamId stream, double cost_s);

  SchedulerOptions options_;
  std::vector<Stream> streams_;
  std::optional<Time> now_;
  double credit_s_;
  double redo_credit_s_;  ///< for doing again what is used before late data of its time
  double floor_s_ = 0.0;  ///< virtual time of the stream that was served last
};

}  // namespace cairn
