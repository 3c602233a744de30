#include "cairn/localization/scheduler.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace cairn {
namespace {

constexpr double kCostMemory = 0.8;
constexpr double kRedoShare = 0.5;  // of the computing time, for what has to be done again
constexpr double kOfRedoCredit =
    0.25;                        // the most that one update may take of it: the dear go where it is little
constexpr double kPlenty = 0.5;  // of the largest credit: then computing time is not short
constexpr Duration kStampTolerance = std::chrono::milliseconds(1);

}  // namespace

void SchedulerOptions::visit(OptionVisitor& v) {
  v.choice({"policy",
            "which measurements are used: all; rate (each stream at most rate_hz); cfs (computing time is "
            "shared fairly between the streams)"},
           policy, {"all", "rate", "cfs"});
  v.number({"rate_hz", "policy rate: updates per second and stream"}, rate_hz, {1e-3, 1e6});
  v.number({"compute_share", "seconds of computing per second that updates may take; 0: no limit"},
           compute_share, {0.0, 1000.0});
  v.integer({"queue", "measurements per stream that may wait for computing time; then the oldest is dropped"},
            queue, {0, 1000});
  v.number({"cost_ns", "modelled cost of one beam in one particle, nanoseconds"}, cost_ns, {0.0, 1e9});
}

Scheduler::Scheduler(const SchedulerOptions& options, std::vector<Share> shares)
    : options_(options),
      streams_(shares.size()),
      credit_s_(options.compute_share),
      redo_credit_s_(kRedoShare * options.compute_share) {
  for (std::size_t i = 0; i < shares.size(); ++i) streams_[i].share = shares[i];
}

void Scheduler::advance(Time now) {
  if (now_ && now > *now_) {
    const double seconds = to_seconds(std::min<Duration>(now - *now_, std::chrono::seconds(1)));
    const double earned_s = options_.compute_share * seconds;
    credit_s_ = std::min(credit_s_ + earned_s, options_.compute_share);
    redo_credit_s_ = std::min(redo_credit_s_ + kRedoShare * earned_s, kRedoShare * options_.compute_share);
  }
  now_ = now;
}

void Scheduler::admit(std::span<Candidate> waiting) {
  if (!limited()) {
    for (Candidate& candidate : waiting) candidate.admitted = true;
    return;
  }
  wake(waiting);
  options_.policy == "cfs" ? admit_fairly(waiting) : admit_oldest(waiting);
}

void Scheduler::wake(std::span<const Candidate> waiting) {
  for (Stream& stream : streams_) stream.saving = false;  // here: nothing waits
  for (const Candidate& candidate : waiting) {
    Stream& stream = streams_[candidate.stream];
    if (!stream.waiting) stream.virtual_s = std::max(stream.virtual_s, floor_s_);
    stream.waiting = stream.saving = true;
  }
  for (Stream& stream : streams_) {
    stream.waiting = stream.saving;
    stream.saving = false;
    stream.planned_s = stream.virtual_s;
  }
}

void Scheduler::admit_oldest(std::span<Candidate> waiting) {
  Plan plan{credit_s_};
  for (Candidate& candidate : waiting) {
    if (plan.credit_s <= 0.0) return;
    serve(candidate, plan);
  }
}

void Scheduler::admit_fairly(std::span<Candidate> waiting) {
  Plan plan{credit_s_};
  double until_s = std::numeric_limits<double>::infinity();
  while (plan.credit_s > 0.0) {
    Candidate* chosen = fairest(waiting, plan);
    if (chosen == nullptr || streams_[chosen->stream].planned_s > until_s) return;
    Stream& stream = streams_[chosen->stream];
    double price = price_s(*chosen, plan);
    if (const Together late = all_late(chosen->stream, waiting); price > stream.cost_s && late.first) {
      chosen = late.first;
      price = late.price_s;
    }
    if (price <= plan.credit_s || plan.credit_s >= options_.compute_share) {
      serve(*chosen, plan);
    } else {
      stream.saving = true;
      until_s = std::min(until_s, stream.planned_s + price * stream.share.nice);
    }
  }
}

// The newest measurement of the stream with the least virtual time; of equals the lower stream.
Scheduler::Candidate* Scheduler::fairest(std::span<Candidate> waiting, const Plan& plan) {
  Candidate* best = nullptr;
  for (Candidate& candidate : waiting) {
    if (candidate.admitted || streams_[candidate.stream].saving || !makes_sense(candidate, plan)) continue;
    const double planned_s = streams_[candidate.stream].planned_s;
    const double best_s = best != nullptr ? streams_[best->stream].planned_s : planned_s;
    const bool fairer =
        best == nullptr || planned_s < best_s || (planned_s == best_s && candidate.stream <= best->stream);
    if (fairer) best = &candidate;
  }
  return best;
}

bool Scheduler::plenty() const { return credit_s_ >= kPlenty * options_.compute_share; }

// The late ones of a stream go back together, for the earliest that does not ask for too much.
Scheduler::Together Scheduler::all_late(StreamId stream, std::span<Candidate> waiting) const {
  Together late;
  double updates_s = 0.0;
  for (std::size_t i = waiting.size(); i-- > 0;) {
    Candidate& candidate = waiting[i];
    if (candidate.stream != stream || candidate.admitted || candidate.rides || candidate.redo_s == 0.0)
      continue;
    updates_s += streams_[stream].cost_s;
    const double price_s = candidate.redo_s + updates_s;
    if (late.first != nullptr && price_s > kRedoShare * options_.compute_share) break;
    late = {&candidate, price_s};
  }
  return late;
}

bool Scheduler::makes_sense(const Candidate& candidate, const Plan& plan) const {
  const double cost_s = streams_[candidate.stream].cost_s;
  if (candidate.rides && candidate.redo_s - plan.redo_s > cost_s && !plenty()) return false;
  const double redo_s = candidate.redos * cost_s;
  return plenty() || redo_s <= kOfRedoCredit * std::max(redo_credit_s_, 0.0) ||
         redo_credit_s_ >= kRedoShare * options_.compute_share;
}

double Scheduler::price_s(const Candidate& candidate, const Plan& plan) const {
  return streams_[candidate.stream].cost_s + std::max(candidate.redo_s - plan.redo_s, 0.0);
}

void Scheduler::serve(Candidate& candidate, Plan& plan) {
  Stream& stream = streams_[candidate.stream];
  const double price = price_s(candidate, plan);
  candidate.admitted = true;
  floor_s_ = std::max(floor_s_, stream.planned_s);
  stream.planned_s += price * stream.share.nice;
  plan.credit_s -= price;
  plan.redo_s = std::max(plan.redo_s, candidate.redo_s);
  if (!plenty()) redo_credit_s_ -= candidate.redos * stream.cost_s;
}

void Scheduler::charge(StreamId id, Duration cost) {
  double& known_s = streams_[id].cost_s;
  const double cost_s = to_seconds(cost);
  known_s = known_s == 0.0 ? cost_s : kCostMemory * known_s + (1.0 - kCostMemory) * cost_s;
  pay(id, cost_s);
}

void Scheduler::charge_redo(StreamId id, Duration cost) { pay(id, to_seconds(cost)); }

void Scheduler::pay(StreamId id, double cost_s) {
  streams_[id].virtual_s += cost_s * streams_[id].share.nice;
  credit_s_ -= cost_s;
}

bool Scheduler::due(StreamId stream, std::optional<Time> last_used, Time stamp) const {
  if (options_.policy != "rate" || !last_used) return true;
  const double rate_hz = streams_[stream].share.rate_hz.value_or(options_.rate_hz);
  return stamp - *last_used + kStampTolerance >= duration_from_seconds(1.0 / rate_hz);
}

}  // namespace cairn
