#include "bench_world.hpp"
#include "cairn/maps/distance_field.hpp"
#include "registration.hpp"

namespace cairn::bench {
namespace {

// Items are cells. One field is made before: the host of a virtual machine may have to provide the pages
// first, which took up to five times as long as the field at 4000 x 4000.
void distance_field(benchmark::State& state, double max_distance_m) {
  const auto map = square_map(static_cast<int>(state.range(0)));
  static_cast<void>(DistanceField(*map, max_distance_m));
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
