#include "bench_world.hpp"
#include "cairn/models/sensor/likelihood_field.hpp"

#include <benchmark/benchmark.h>

namespace cairn::bench {
namespace {

void distance_field(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(DistanceField(*bench_world().map, 2.0));
}
BENCHMARK(distance_field)->Name("cairn/distance_field/1000x1000")->Unit(benchmark::kMillisecond);

// Items are particles times beams, here and in all likelihood benchmarks.
void weigh(benchmark::State& state, std::vector<Pose2> (*particles)(std::size_t)) {
  const BenchWorld& world = bench_world();
  LikelihoodFieldOptions options;
  options.max_beams = 0;
  const auto field = std::make_shared<const DistanceField>(*world.map, options.max_distance_m);
  const LikelihoodField model(field, {}, {}, options);
  const std::vector<Pose2> states = particles(static_cast<std::size_t>(state.range(0)));
  std::vector<double> out(states.size());
  for (auto _ : state) {
    model.log_likelihood(world.scan, states, out);
    benchmark::DoNotOptimize(out.data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0) *
                          static_cast<std::int64_t>(world.scan.ranges_m.size()));
}
BENCHMARK_CAPTURE(weigh, tracking, tracking_particles)
    ->Name("cairn/likelihood_field/tracking")
    ->Arg(2000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(weigh, global, global_particles)
    ->Name("cairn/likelihood_field/global")
    ->Arg(10000)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace cairn::bench
