#include "bench_world.hpp"
#include "cairn/maps/distance_field.hpp"
#include "registration.hpp"

namespace cairn::bench {
namespace {

// Items are cells.
void distance_field(benchmark::State& state, double max_distance_m) {
  const auto map = square_map(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    const DistanceField field(*map, max_distance_m);
    benchmark::DoNotOptimize(field.squared_cells(0));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(map->geometry().size()));
}

}  // namespace

void register_maps() {
  const auto paths = paths_to_measure();
  on_paths("distance_field_30cm", paths, {1000, 4000}, [](auto& state) { distance_field(state, 0.3); });
  on_paths("distance_field_2m", paths, {1000, 4000}, [](auto& state) { distance_field(state, 2.0); });
}

}  // namespace cairn::bench
