// What the run-time core costs per event: all of it but the models and the filter, which are fakes.
#include "fake_fusion.hpp"

#include <benchmark/benchmark.h>

namespace cairn::bench {
namespace {

constexpr int kPerSecond = 100;

// One second of odometry at 100 Hz, a sensor at 40 Hz and one at 10 Hz that comes `lag_s` late.
std::vector<Event> one_second(double lag_s) {
  std::vector<Event> events;
  for (int tick = 0; tick < kPerSecond; ++tick) {
    const double t = static_cast<double>(tick) / kPerSecond;
    events.push_back(test::odometry_event(t, test::on_circle({}, t)));
    if (tick % 5 < 2) events.push_back(test::fake_measurement(t - 0.003, 1));
    if (tick % 10 == 7) events.push_back(test::fake_measurement(t - lag_s, 2, lag_s));
  }
  return events;
}

void shift(std::vector<Event>& events, Duration by) {
  for (Event& event : events) {
    event.stamp += by;
    event.arrival += by;
    if (auto* odometry = std::get_if<Odometry>(&event.payload)) {
      odometry->stamp += by;
    } else {
      std::const_pointer_cast<LaserScan>(std::get<std::shared_ptr<const LaserScan>>(event.payload))->stamp +=
          by;
    }
  }
}

void process_events(benchmark::State& state, double lag_s, const char* scheduler, double compute_share) {
  FusionParts parts = test::fake_parts(nullptr, {1.0, 5.0});
  parts.scheduler.policy = scheduler;
  parts.scheduler.compute_share = compute_share;
  FusionLocalizer localizer(std::move(parts));
  std::vector<Event> events = one_second(lag_s);
  std::int64_t second = 0;
  for (auto _ : state) {
    for (const Event& event : events) localizer.process(event);
    state.PauseTiming();
    // Scans that the history still holds must keep their stamps.
    events = one_second(lag_s);
    shift(events, std::chrono::seconds(++second));
    state.ResumeTiming();
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(events.size()));
}

void in_order(benchmark::State& state) { process_events(state, 0.0, "all", 0.0); }
void late(benchmark::State& state) { process_events(state, 0.5, "all", 0.0); }
void scheduled(benchmark::State& state) { process_events(state, 0.0, "cfs", 0.5); }

BENCHMARK(in_order)->Name("cairn/core_150_events/in_order")->Unit(benchmark::kMicrosecond);
BENCHMARK(late)->Name("cairn/core_150_events/ten_late_by_500_ms")->Unit(benchmark::kMicrosecond);
BENCHMARK(scheduled)->Name("cairn/core_150_events/cfs")->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace cairn::bench
