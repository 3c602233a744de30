#include "bench_world.hpp"
#include "cairn/bayes/particle_filter.hpp"
#include "cairn/localization/recipes.hpp"
#include "cairn/models/sensor/likelihood_field.hpp"

#include <benchmark/benchmark.h>

namespace cairn::bench {
namespace {

constexpr Pose2 kControl{0.1, 0.0, 0.02};

void sample_motion(benchmark::State& state) {
  const DifferentialDrive model{DifferentialDriveOptions{}};
  std::vector<Pose2> states = tracking_particles(static_cast<std::size_t>(state.range(0)));
  std::uint64_t step = 0;
  for (auto _ : state) {
    model.propagate(kControl, states, RandomStream(1, RandomPurpose::kMotion, step++));
    benchmark::DoNotOptimize(states.data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(sample_motion)->Name("cairn/motion_sampling")->Arg(2000)->Unit(benchmark::kMicrosecond);

void resample(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  std::vector<double> log_weights(count);
  const RandomStream random(1, RandomPurpose::kTest, 1);
  for (std::size_t i = 0; i < count; ++i) log_weights[i] = random.normal4(static_cast<std::uint32_t>(i))[0];
  normalize_log_weights(log_weights);
  std::vector<std::uint32_t> ancestors;
  for (auto _ : state) {
    ancestors.clear();
    draw_systematic(cumulative_weights(log_weights), count, 0.5, ancestors);
    benchmark::DoNotOptimize(ancestors.data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(resample)->Name("cairn/resampling")->Arg(2000)->Unit(benchmark::kMicrosecond);

// Resample, predict, weigh on one thread. The robot stands; the odometry goes to and fro.
void whole_step(benchmark::State& state) {
  const BenchWorld& world = bench_world();
  LocalizerOptions options;
  options.recipe = "mcl";
  options.filter.particles = static_cast<int>(state.range(0));
  options.filter.resample.ess_ratio = 1.0;
  auto filter = make_filter(options, 1, std::make_shared<const Executor>(1));
  const std::vector<Pose2> start = tracking_particles(static_cast<std::size_t>(state.range(0)));
  filter.initialize([&](const RandomStream&, std::uint32_t i) { return start[i]; });
  const auto field =
      std::make_shared<const DistanceField>(*world.map, options.laser.likelihood_field.max_distance_m);
  const LikelihoodField model(field, {}, {}, options.laser.likelihood_field);
  Pose2 control = kControl;
  for (auto _ : state) {
    filter.update(control, model.bind(world.scan));
    control = inverse(control);
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(whole_step)
    ->Name("cairn/whole_step")
    ->Arg(500)
    ->Arg(2000)
    ->Arg(10000)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace cairn::bench
