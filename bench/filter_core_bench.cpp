// What the particle filter itself costs: everything but the models, which here do next to nothing.
#include "cairn/bayes/particle_filter.hpp"
#include "cairn/bayes/pose_kernel.hpp"
#include "cairn/bayes/resampling/resampling_schemes.hpp"

#include <memory>
#include <string>

#include <benchmark/benchmark.h>

namespace cairn::bench {
namespace {

struct Stay final : MotionModel<Pose2, Pose2> {
  void propagate(const Pose2&, std::span<Pose2>, const RandomStream&) const override {}
};

using Filter = ParticleFilter<Pose2, Pose2>;

Filter make_filter(std::unique_ptr<SampleSize<Pose2>> size, const std::string& scheme) {
  Filter filter(std::make_shared<const Stay>(),
                {.size = std::move(size),
                 .resampling = make_resampling(scheme),
                 .regularization = std::make_unique<PoseKernel>(PoseKernelOptions{})},
                std::make_shared<const Executor>(), {.seed = 1, .min_ess_share = 0.15});
  filter.initialize([](const RandomStream& random, std::uint32_t i) {
    const auto n = random.normal4(i);
    return Pose2{0.1 * n[0], 0.1 * n[1], 0.05 * n[2]};
  });
  return filter;
}

// Weights of different size, so that the next step resamples.
BoundUpdate<Pose2> slope() {
  return {Time{}, [](std::span<const Pose2> poses, std::span<double> out) {
            for (std::size_t i = 0; i < poses.size(); ++i) out[i] = 3.0 * poses[i].x;
          }};
}

void steps(benchmark::State& state, Filter filter) {
  const BoundUpdate<Pose2> z = slope();
  filter.correct(z);
  const Filter::Checkpoint spread = filter.checkpoint();  // without motion the particles would soon be one
  for (auto _ : state) {
    filter.restore(spread);
    filter.update({}, z);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(filter.particles().size()));
}

void step_with(benchmark::State& state, const std::string& scheme) {
  steps(state, make_filter(std::make_unique<FixedSize<Pose2>>(2000), scheme));
}

void kld_step(benchmark::State& state) {
  steps(state, make_filter(std::make_unique<KldSize>(KldOptions{}, 2000, 2000), "systematic"));
}
BENCHMARK(kld_step)->Name("cairn/filter_core/kld/2000")->Unit(benchmark::kMicrosecond);

void checkpoint(benchmark::State& state) {
  const Filter filter = make_filter(std::make_unique<FixedSize<Pose2>>(2000), "systematic");
  Filter::Checkpoint buffer;
  for (auto _ : state) {
    filter.save(buffer);
    benchmark::DoNotOptimize(buffer.particles.states.data());
  }
}
BENCHMARK(checkpoint)->Name("cairn/filter_core/checkpoint/2000")->Unit(benchmark::kMicrosecond);

const bool kRegistered = [] {
  for (const std::string& scheme : resampling_schemes()) {
    const auto run = [scheme](benchmark::State& state) { step_with(state, scheme); };
    benchmark::RegisterBenchmark(("cairn/filter_core/" + scheme + "/2000").c_str(), run)
        ->Unit(benchmark::kMicrosecond);
  }
  return true;
}();

}  // namespace
}  // namespace cairn::bench
