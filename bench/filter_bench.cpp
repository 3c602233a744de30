#include "bench_world.hpp"
#include "cairn/bayes/particle_filter.hpp"
#include "cairn/bayes/pose_kernel.hpp"
#include "cairn/localization/recipes.hpp"
#include "cairn/models/motion/differential_drive.hpp"
#include "cairn/models/sensor/likelihood_field.hpp"
#include "registration.hpp"

namespace cairn::bench {
namespace {

constexpr Pose2 kControl{0.1, 0.0, 0.02};

std::shared_ptr<const LikelihoodField> laser_model(const LikelihoodFieldOptions& options) {
  return std::make_shared<const LikelihoodField>(
      std::make_shared<const DistanceField>(*bench_world().map, options.max_distance_m), Pose2{},
      BeamLimits{}, options);
}

// Weights of very different size, as a correction leaves them.
std::vector<double> some_weights(std::size_t count) {
  std::vector<double> log_weights(count), weights;
  const RandomStream random(1, RandomPurpose::kTest, 1);
  for (std::size_t i = 0; i < count; ++i) log_weights[i] = random.normal4(static_cast<std::uint32_t>(i))[0];
  normalize_weights(log_weights, weights);
  return weights;
}

// Draws a generation and asks KLD-sampling how large it must be. Items are particles.
void resample_kld(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  const std::vector<Pose2> states = tracking_particles(count);
  const std::vector<double> weights = some_weights(count);
  std::vector<double> cumulative;
  std::vector<std::uint32_t> ancestors;
  std::vector<Pose2> next;
  KldSize size({}, count, count);
  for (auto _ : state) {
    cumulative_sums(weights, cumulative);
    ancestors.clear();
    draw_systematic(cumulative, size.begin(), 0.5, ancestors);
    next.resize(ancestors.size());
    copy_drawn(std::span<const Pose2>(states), ancestors, next);
    benchmark::DoNotOptimize(size.wanted(next));
    benchmark::DoNotOptimize(next.data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

// One turn of the filter and its estimate, on one thread. The robot stands; the odometry goes to and fro.
void step(benchmark::State& state, const ParticleFilterOptions& options,
          std::unique_ptr<Regularization<Pose2>> regularization) {
  const auto count = static_cast<std::size_t>(state.range(0));
  ParticleFilter<Pose2, Pose2> filter(std::make_shared<const DifferentialDrive>(DifferentialDriveOptions{}),
                                      std::make_unique<KldSize>(KldOptions{}, count, count),
                                      std::move(regularization), std::make_shared<const Executor>(1),
                                      options);
  const std::vector<Pose2> start = tracking_particles(count);
  filter.initialize([&](const RandomStream&, std::uint32_t i) { return start[i]; });
  const auto model = laser_model({});
  Pose2 control = kControl;
  for (auto _ : state) {
    filter.update(control, model->bind(bench_world().scan));
    benchmark::DoNotOptimize(weighted_moments(filter.particles().states, filter.particles().weights));
    control = inverse(control);
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

}  // namespace

void register_filter() {
  const auto paths = paths_to_measure();
  on_paths("resample_kld", paths, {2000}, resample_kld);
  on_paths("whole_step", paths, {500, 2000, 10000}, [](auto& state) { step(state, {}, nullptr); });
  on_paths("whole_step_in_portions", paths, {500, 2000, 10000}, [](auto& state) {
    step(state, {.min_ess_share = 0.15}, std::make_unique<PoseKernel>(PoseKernelOptions{}));
  });
}

}  // namespace cairn::bench
