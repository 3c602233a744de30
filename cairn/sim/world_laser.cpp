#include "cairn/sim/world_laser.hpp"

#include "cairn/sim/simulation_random.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

constexpr double kGlassReturns_rad = 0.1745;  // 10 degrees
constexpr int kMostSurfaces = 24;
constexpr int kMostMirrors = 4;
constexpr double kMeshReturns = 0.5;

}  // namespace

BeamCaster::BeamCaster(const World& world, const WallGrid& walls, const People& people, double time_s,
                       double height_m)
    : scene_(world, walls, people, time_s), height_m_(height_m) {}

bool returns_light(const WorldScene::Surface& surface, double incidence_rad, double mesh_draw) {
  switch (surface.material) {
    case Material::kOpaque:
      return true;
    case Material::kGlass:
      return incidence_rad <= kGlassReturns_rad;
    case Material::kMesh:
      return mesh_draw < kMeshReturns;
    case Material::kMirror:
      return false;
  }
  return false;
}

std::optional<BeamCaster::Return> BeamCaster::cast(const Point2& origin, double angle_rad, double max_range_m,
                                                   double mesh_draw) const {
  Point2 at = origin;
  Point2 direction{std::cos(angle_rad), std::sin(angle_rad)};
  double travelled = 0.0;
  int mirrors = 0;
  for (int surface = 0; surface < kMostSurfaces && travelled < max_range_m; ++surface) {
    const auto met = scene_.nearest(at, direction, max_range_m - travelled);
    if (!met) return std::nullopt;
    const double incidence = met->incidence_rad(direction);
    const bool is_there = met->span.contains(height_m_);
    const bool is_mirror = is_there && met->material == Material::kMirror;
    if (is_there && returns_light(*met, incidence, mesh_draw))
      return Return{travelled + met->range_m, incidence};
    if (is_mirror && ++mirrors > kMostMirrors) return std::nullopt;
    at = {at.x + met->range_m * direction.x, at.y + met->range_m * direction.y};
    if (is_mirror) direction = reflected(direction, met->along);
    at = {at.x + WorldScene::kPassed_m * direction.x, at.y + WorldScene::kPassed_m * direction.y};
    travelled += met->range_m + WorldScene::kPassed_m;
  }
  return std::nullopt;
}

namespace {

float measured_range(const std::optional<BeamCaster::Return>& met, const WorldLaserOptions& o,
                     const RandomStream& random, std::uint32_t beam) {
  const auto fate = random.uniform4(beam, 1);
  const double span = o.range_max_m - o.range_min_m;
  if (fate[0] < o.no_return_share) return static_cast<float>(o.range_max_m);
  if (fate[1] < o.random_share) return static_cast<float>(o.range_min_m + fate[3] * span);
  const double truth = met && met->incidence_rad <= o.grazing_rad ? met->range_m : o.range_max_m;
  if (fate[2] < o.short_share)
    return static_cast<float>(o.range_min_m + fate[3] * std::max(0.0, truth - o.range_min_m));
  if (truth >= o.range_max_m) return static_cast<float>(o.range_max_m);
  const double sigma = o.sigma_range_m + o.sigma_per_m2 * truth * truth;
  return static_cast<float>(std::clamp(truth + sigma * random.normal4(beam, 0)[0], 0.0, o.range_max_m));
}

Pose2 pose_then(const Trajectory& truth, Time stamp) {
  return *pose_at(truth, std::clamp(stamp, truth.front().stamp, truth.back().stamp));
}

}  // namespace

LaserScan simulate_world_scan(const World& world, const WallGrid& walls, const People& people,
                              const Trajectory& truth, const WorldLaserOptions& o, Time measured,
                              std::size_t stream, std::uint64_t index, std::uint64_t seed) {
  LaserScan scan;
  scan.stamp = measured;
  scan.angle_min_rad = -0.5 * o.field_of_view_rad;
  scan.angle_increment_rad = o.field_of_view_rad / (o.beams - 1);
  scan.range_min_m = o.range_min_m;
  scan.range_max_m = o.range_max_m;
  scan.ranges_m.reserve(static_cast<std::size_t>(o.beams));
  const BeamCaster caster(world, walls, people, to_seconds(measured), o.height_m);
  const RandomStream random =
      simulation_random(seed, SimulationUse::kLaserNoise, step_of_stream(stream, index));
  const Pose2 T_base_laser = parse_world_pose("mount", o.mount);
  Pose2 T_map_laser = pose_then(truth, measured) * T_base_laser;
  for (int beam = 0; beam < o.beams; ++beam) {
    if (o.sweep_s > 0.0) {
      const Duration since = duration_from_seconds(o.sweep_s * beam / (o.beams - 1));
      T_map_laser = pose_then(truth, measured + since) * T_base_laser;
    }
    const double angle = T_map_laser.theta + scan.angle_min_rad + beam * scan.angle_increment_rad;
    const auto item = static_cast<std::uint32_t>(beam);
    const auto met =
        caster.cast({T_map_laser.x, T_map_laser.y}, angle, o.range_max_m, random.uniform(item, 2));
    scan.ranges_m.push_back(measured_range(met, o, random, item));
  }
  return scan;
}

}  // namespace cairn
