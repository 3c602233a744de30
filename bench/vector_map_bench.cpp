// A real building (GHC7: 2782 walls, 60 m x 113 m) where the recordings are at hand; 2000 random walls
// elsewhere.

#include "cairn/core/angle.hpp"
#include "cairn/io/input_file.hpp"
#include "cairn/io/vector_text.hpp"
#include "cairn/maps/ray_casting.hpp"
#include "cairn/models/sensor/vector_laser.hpp"
#include "random_walls.hpp"
#include "test_data.hpp"

#include <cmath>
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>

namespace cairn::bench {
namespace {

constexpr int kBeams = 360;

struct VectorWorld {
  std::shared_ptr<const WallGrid> walls;
  std::vector<Pose2> poses;  ///< in rooms: something is seen all around, nothing within 0.3 m
  std::vector<Point2> directions;
  LaserScan scan;  ///< from the first pose
};

std::shared_ptr<const VectorMap> read_building() {
  const auto file = test::data_file("vector_maps/GHC7_vector.txt");
  if (file.empty()) return std::make_shared<const VectorMap>(test::random_walls(2000, 60.0, 4.0, 1));
  Diagnostics diagnostics;
  return std::make_shared<const VectorMap>(read_vector_text(*open_input(file), file.string(), diagnostics));
}

bool is_in_room(const VectorWorld& world, const Point2& p) {
  for (std::size_t i = 0; i < world.directions.size(); i += 10) {
    const RayHit hit = cast_ray(*world.walls, p, world.directions[i]);
    if (!hit || hit.range_m < 0.3) return false;
  }
  return true;
}

VectorWorld make_world() {
  VectorWorld world{std::make_shared<const WallGrid>(read_building()), {}, {}, {}};
  for (int i = 0; i < kBeams; ++i) {
    world.directions.push_back({std::cos(kTwoPi * i / kBeams), std::sin(kTwoPi * i / kBeams)});
  }
  const Bounds2& b = world.walls->map().bounds();
  const RandomStream random(1, RandomPurpose::kTest, 0);
  for (std::uint32_t i = 0; world.poses.size() < 200; ++i) {
    const auto u = random.uniform4(i);
    const Point2 p{b.min.x + u[0] * (b.max.x - b.min.x), b.min.y + u[1] * (b.max.y - b.min.y)};
    if (is_in_room(world, p)) world.poses.push_back({p.x, p.y, kTwoPi * u[2] - kPi});
  }
  world.scan.angle_increment_rad = kTwoPi / kBeams;
  world.scan.range_max_m = 100.0;
  const Pose2& at = world.poses.front();
  for (int i = 0; i < kBeams; ++i) {
    const double angle = at.theta + kTwoPi * i / kBeams;
    const RayHit hit = cast_ray(*world.walls, {at.x, at.y}, {std::cos(angle), std::sin(angle)});
    world.scan.ranges_m.push_back(static_cast<float>(hit.range_m));
  }
  return world;
}

const VectorWorld& world() {
  static const VectorWorld made = make_world();
  return made;
}

void rays(benchmark::State& state) {
  const VectorWorld& w = world();
  for (auto _ : state) {
    double sum = 0.0;
    for (const Pose2& pose : w.poses) {
      for (const Point2& u : w.directions) sum += cast_ray(*w.walls, {pose.x, pose.y}, u, 100.0).range_m;
    }
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() *
                          static_cast<std::int64_t>(w.poses.size() * w.directions.size()));
}
BENCHMARK(rays)->Name("cairn/vector_map/rays")->Unit(benchmark::kMillisecond);

void render(benchmark::State& state) {
  const VectorWorld& w = world();
  VisibilityRenderer renderer(*w.walls);
  for (auto _ : state) {
    std::size_t pieces = 0;
    for (const Pose2& pose : w.poses) pieces += renderer.render({pose.x, pose.y}, 1e9).size();
    benchmark::DoNotOptimize(pieces);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(w.poses.size()));
}
BENCHMARK(render)->Name("cairn/vector_map/render")->Unit(benchmark::kMillisecond);

// Items are particles.
void weigh(benchmark::State& state) {
  const VectorWorld& w = world();
  const VectorLaser model(w.walls, {}, {}, {});
  const auto z = model.bind(w.scan);
  std::vector<Pose2> states(static_cast<std::size_t>(state.range(0)));
  const RandomStream random(2, RandomPurpose::kTest, 0);
  for (std::uint32_t i = 0; i < states.size(); ++i) {
    const auto g = random.normal4(i);
    const Pose2& at = w.poses.front();
    states[i] = {at.x + 0.1 * g[0], at.y + 0.1 * g[1], at.theta + 0.05 * g[2]};
  }
  std::vector<double> out(states.size());
  for (auto _ : state) {
    z.log_likelihood(states, out);
    benchmark::DoNotOptimize(out.data());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(weigh)->Name("cairn/vector_laser/tracking")->Arg(20)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace cairn::bench
