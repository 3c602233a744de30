#include "cairn/localization/scheduler.hpp"

#include <algorithm>
#include <utility>

namespace cairn {
namespace {

constexpr double kCostMemory = 0.8;
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
    : options_(options), streams_(shares.size()), credit_s_(options.compute_share) {
  for (std::size_t i = 0; i < shares.size(); ++i) streams_[i].share = shares[i];
}

void Scheduler::advance(Time now) {
  if (now_ && now > *now_) {
    const double earned = to_seconds(std::min<Duration>(now - *now_, std::chrono::seconds(1)));
    credit_s_ = std::min(credit_s_ + options_.compute_share * earned, options_.compute_share);
  }
  now_ = now;
}

void Scheduler::admit(std::span<Candidate> waiting) {
  if (!limited()) {
    for (Candidate& candidate : waiting) candidate.admitted = true;
    return;
  }
  wake(waiting);
  double credit_s = credit_s_;
  while (credit_s > 0.0) {
    Candidate* chosen = next(waiting);
    if (chosen == nullptr) return;
    chosen->admitted = true;
    Stream& stream = streams_[chosen->stream];
    floor_s_ = std::max(floor_s_, stream.planned_s);
    stream.planned_s += stream.cost_s * stream.share.nice;
    credit_s -= stream.cost_s;
  }
}

void Scheduler::wake(std::span<const Candidate> waiting) {
  for (const Candidate& candidate : waiting) {
    Stream& stream = streams_[candidate.stream];
    if (!stream.waiting) stream.virtual_s = std::max(stream.virtual_s, floor_s_);
    stream.waiting = true;
  }
  for (Stream& stream : streams_) stream.planned_s = stream.virtual_s;
}

Scheduler::Candidate* Scheduler::next(std::span<Candidate> waiting) {
  if (options_.policy == "cfs") return fairest(waiting);
  const auto first = std::find_if(waiting.begin(), waiting.end(), [](const auto& c) { return !c.admitted; });
  return first == waiting.end() ? nullptr : &*first;
}

// The newest measurement of the stream with the least virtual time; of equals the lower stream.
Scheduler::Candidate* Scheduler::fairest(std::span<Candidate> waiting) {
  Candidate* best = nullptr;
  for (Candidate& candidate : waiting) {
    if (candidate.admitted) continue;
    const double planned_s = streams_[candidate.stream].planned_s;
    const double best_s = best != nullptr ? streams_[best->stream].planned_s : planned_s;
    const bool fairer =
        best == nullptr || planned_s < best_s || (planned_s == best_s && candidate.stream <= best->stream);
    if (fairer) best = &candidate;
  }
  return best;
}

void Scheduler::charge(StreamId id, Duration cost) {
  Stream& stream = streams_[id];
  const double cost_s = to_seconds(cost);
  stream.cost_s = stream.cost_s == 0.0 ? cost_s : kCostMemory * stream.cost_s + (1.0 - kCostMemory) * cost_s;
  stream.virtual_s += cost_s * stream.share.nice;
  credit_s_ -= cost_s;
  stream.waiting = false;
}

bool Scheduler::due(StreamId stream, std::optional<Time> last_used, Time stamp) const {
  if (options_.policy != "rate" || !last_used) return true;
  const double rate_hz = streams_[stream].share.rate_hz.value_or(options_.rate_hz);
  return stamp - *last_used + kStampTolerance >= duration_from_seconds(1.0 / rate_hz);
}

}  // namespace cairn
