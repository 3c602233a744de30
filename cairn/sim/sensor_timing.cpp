#include "cairn/sim/sensor_timing.hpp"

#include "cairn/sim/simulation_random.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

/// A time in which messages are held up or lost.
struct Burst {
  double from_s;
  double to_s;

  bool contains(double time_s) const { return time_s >= from_s && time_s < to_s; }
};

// Times between bursts are exponential: one says nothing of the next.
std::vector<Burst> make_bursts(SimulationUse use, double every_s, double length_s, double end_s,
                               std::size_t stream, std::uint64_t seed) {
  std::vector<Burst> bursts;
  double t = 0.0;
  while (every_s > 0.0) {
    const auto step = step_of_stream(stream, bursts.size());
    t += -every_s * std::log(simulation_random(seed, use, step).uniform(1));
    if (t > end_s) break;
    bursts.push_back({t, t + length_s});
    t += length_s;
  }
  return bursts;
}

double arrival_of(double measured_s, const WorldTimingOptions& o, double delay_draw,
                  const std::vector<Burst>& stalls) {
  const double arrival = measured_s + o.latency_s - o.latency_jitter_s * std::log(delay_draw);
  for (const Burst& stall : stalls) {
    if (stall.contains(measured_s)) return std::max(arrival, stall.to_s);
  }
  return arrival;
}

}  // namespace

std::vector<MessageTiming> message_timings(const WorldTimingOptions& o, Time end, std::size_t stream,
                                           std::uint64_t seed) {
  const double end_s = to_seconds(end);
  const double period = 1.0 / o.rate_hz;
  const auto stalls = make_bursts(SimulationUse::kTiming, o.stall_every_s, o.stall_s, end_s, stream, seed);
  const auto outages =
      make_bursts(SimulationUse::kOutages, o.outage_every_s, o.outage_s, end_s, stream, seed);
  std::vector<MessageTiming> messages;
  const auto count = static_cast<std::uint64_t>(std::floor(end_s * o.rate_hz + 1e-9)) + 1;
  for (std::uint64_t i = 0; i < count; ++i) {
    const RandomStream random = simulation_random(seed, SimulationUse::kDelivery, step_of_stream(stream, i));
    const double jitter = std::clamp(o.jitter_s * random.normal4(0)[0], -0.3 * period, 0.3 * period);
    const auto draws = random.uniform4(1);
    if (draws[0] < o.lost_share) continue;
    const double measured = std::clamp(static_cast<double>(i) * period + jitter, 0.0, end_s);
    const auto is_out = [measured](const Burst& outage) { return outage.contains(measured); };
    if (std::any_of(outages.begin(), outages.end(), is_out)) continue;
    const Time at = Time{} + duration_from_seconds(measured);
    messages.push_back({i, at, at + duration_from_seconds(o.clock_offset_s),
                        Time{} + duration_from_seconds(arrival_of(measured, o, draws[1], stalls))});
  }
  return messages;
}

}  // namespace cairn
