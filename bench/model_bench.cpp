#include "bench_world.hpp"
#include "cairn/maps/ray_marching.hpp"
#include "cairn/models/motion/differential_drive.hpp"
#include "cairn/models/sensor/beam_model.hpp"
#include "cairn/models/sensor/likelihood_field.hpp"
#include "registration.hpp"

namespace cairn::bench {
namespace {

using Particles = std::vector<Pose2> (*)(std::size_t);

// Items are particles times beams, here and in all benchmarks of sensor models.
void weigh(benchmark::State& state, const LaserModel& model, Particles particles) {
  const BenchWorld& world = bench_world();
  const std::vector<Pose2> states = particles(static_cast<std::size_t>(state.range(0)));
  std::vector<double> out(states.size());
  for (auto _ : state) {
    model.log_likelihood(world.scan, states, out);
    benchmark::DoNotOptimize(out.data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0) *
                          static_cast<std::int64_t>(world.scan.ranges_m.size()));
}

void likelihood_field(benchmark::State& state, Particles particles) {
  LikelihoodFieldOptions options;
  options.max_beams = 0;
  const auto field = std::make_shared<const DistanceField>(*bench_world().map, options.max_distance_m);
  weigh(state, LikelihoodField(field, {}, {}, options), particles);
}

void beam_model(benchmark::State& state) {
  BeamModelOptions options;
  options.max_beams = 0;
  const auto marcher = std::make_shared<const RayMarcher>(*bench_world().map, bench_world().scan.range_max_m);
  weigh(state, BeamModel(marcher, {}, {}, options), tracking_particles);
}

// Items are rays.
void ray_casting(benchmark::State& state, Particles particles) {
  const LaserScan& scan = bench_world().scan;
  const RayMarcher marcher(*bench_world().map, scan.range_max_m);
  const std::vector<Pose2> states = particles(static_cast<std::size_t>(state.range(0)));
  std::vector<double> bearings;
  for (std::size_t k = 0; k < scan.ranges_m.size(); ++k)
    bearings.push_back(scan.angle_min_rad + static_cast<double>(k) * scan.angle_increment_rad);
  std::vector<float> ranges(states.size() * bearings.size());
  for (auto _ : state) {
    marcher.cast(states, bearings, ranges);
    benchmark::DoNotOptimize(ranges.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(ranges.size()));
}

void motion(benchmark::State& state) {
  const DifferentialDrive model{DifferentialDriveOptions{}};
  std::vector<Pose2> states = tracking_particles(static_cast<std::size_t>(state.range(0)));
  std::uint64_t step = 0;
  for (auto _ : state) {
    model.propagate({0.1, 0.0, 0.02}, states, RandomStream(1, RandomPurpose::kMotion, step++));
    benchmark::DoNotOptimize(states.data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

}  // namespace

void register_models() {
  const auto paths = paths_to_measure();
  on_paths("likelihood_field_tracking", paths, {500, 2000, 10000},
           [](auto& state) { likelihood_field(state, tracking_particles); });
  on_paths("likelihood_field_global", paths, {10000},
           [](auto& state) { likelihood_field(state, global_particles); });
  on_paths("beam_model_tracking", paths, {500}, beam_model);
  on_paths("ray_casting_tracking", paths, {500}, [](auto& state) { ray_casting(state, tracking_particles); });
  on_paths("ray_casting_global", paths, {500}, [](auto& state) { ray_casting(state, global_particles); });
  on_paths("motion_sampling", paths, {2000}, motion);
}

}  // namespace cairn::bench
