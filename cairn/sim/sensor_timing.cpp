#include "cairn/sim/sensor_timing.hpp"

#include "cairn/sim/simulation_random.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

struct Stall {
  double from_s;
  double to_s;
};

// Times between stalls are exponential: a stall says nothing of the next one.
std::vector<Stall> make_stalls(const WorldTimingOptions& o, double end_s, std::size_t stream,
                               std::uint64_t seed) {
  std::vector<Stall> stalls;
  double t = 0.0;
  while (o.stall_every_s > 0.0) {
    const auto step = step_of_stream(stream, stalls.size());
    t += -o.stall_every_s * std::log(simulation_random(seed, SimulationUse::kTiming, step).uniform(1));
    if (t > end_s) break;
    stalls.push_back({t, t + o.stall_s});
    t += o.stall_s;
  }
  return stalls;
}

double arrival_of(double measured_s, const WorldTimingOptions& o, double delay_draw,
                  const std::vector<Stall>& stalls) {
  const double arrival = measured_s + o.latency_s - o.latency_jitter_s * std::log(delay_draw);
  for (const Stall& stall : stalls) {
    if (measured_s >= stall.from_s && measured_s < stall.to_s) return std::max(arrival, stall.to_s);
  }
  return arrival;
}

}  // namespace

std::vector<MessageTiming> message_timings(const WorldTimingOptions& o, Time end, std::size_t stream,
                                           std::uint64_t seed) {
  const double end_s = to_seconds(end);
  const double period = 1.0 / o.rate_hz;
  const std::vector<Stall> stalls = make_stalls(o, end_s, stream, seed);
  std::vector<MessageTiming> messages;
  const auto count = static_cast<std::uint64_t>(std::floor(end_s * o.rate_hz + 1e-9)) + 1;
  for (std::uint64_t i = 0; i < count; ++i) {
    const RandomStream random = simulation_random(seed, SimulationUse::kDelivery, step_of_stream(stream, i));
    const double jitter = std::clamp(o.jitter_s * random.normal4(0)[0], -0.3 * period, 0.3 * period);
    const auto draws = random.uniform4(1);
    if (draws[0] < o.lost_share) continue;
    const double measured = std::clamp(static_cast<double>(i) * period + jitter, 0.0, end_s);
    const Time at = Time{} + duration_from_seconds(measured);
    messages.push_back({i, at, at + duration_from_seconds(o.clock_offset_s),
                        Time{} + duration_from_seconds(arrival_of(measured, o, draws[1], stalls))});
  }
  return messages;
}

}  // namespace cairn
