#include "cairn/sim/world_laser.hpp"

#include "cairn/maps/ray_casting.hpp"
#include "cairn/sim/simulation_random.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn {
namespace {

constexpr double kGlassReturns_rad = 0.1745;  // 10 degrees
constexpr double kPassed_m = 1e-6;            // beyond a surface that let the beam through
constexpr int kMostSurfaces = 12;
constexpr int kMostMirrors = 4;
constexpr double kMeshReturns = 0.5;

double cross(const Point2& a, const Point2& b) { return a.x * b.y - a.y * b.x; }
double dot(const Point2& a, const Point2& b) { return a.x * b.x + a.y * b.y; }

Point2 direction_of(const Wall& wall) {
  const double length = std::hypot(wall.b.x - wall.a.x, wall.b.y - wall.a.y);
  return {(wall.b.x - wall.a.x) / length, (wall.b.y - wall.a.y) / length};
}

double hit(const Point2& origin, const Point2& direction, const Wall& wall) {
  const Point2 edge{wall.b.x - wall.a.x, wall.b.y - wall.a.y};
  const Point2 to_wall{wall.a.x - origin.x, wall.a.y - origin.y};
  const double denominator = cross(direction, edge);
  if (denominator == 0.0) return std::numeric_limits<double>::infinity();
  const double along = cross(to_wall, direction) / denominator;
  const double range = cross(to_wall, edge) / denominator;
  return along >= 0.0 && along <= 1.0 && range >= 0.0 ? range : std::numeric_limits<double>::infinity();
}

double hit(const Point2& origin, const Point2& direction, const Cylinder& person) {
  const Point2 to{person.center.x - origin.x, person.center.y - origin.y};
  const double aside = cross(direction, to), ahead = dot(direction, to);
  if (ahead < 0.0 || std::abs(aside) > person.radius_m) return std::numeric_limits<double>::infinity();
  return std::max(0.0, ahead - std::sqrt(person.radius_m * person.radius_m - aside * aside));
}

Point2 reflected(const Point2& direction, const Point2& along) {
  const double s = 2.0 * dot(direction, along);
  return {s * along.x - direction.x, s * along.y - direction.y};
}

}  // namespace

BeamCaster::BeamCaster(const World& world, const WallGrid& walls, const People& people, double time_s)
    : walls_(walls), people_(people.at(time_s)) {
  for (const WorldDoor& door : world.doors) {
    if (door.is_closed(time_s)) closed_doors_.push_back(door.leaf);
  }
}

std::optional<BeamCaster::Surface> BeamCaster::nearest(const Point2& origin, const Point2& direction,
                                                       double max_range_m) const {
  std::optional<Surface> found;
  double range = max_range_m;
  if (const RayHit wall = cast_ray(walls_, origin, direction, max_range_m)) {
    const Wall& met = walls_.map().walls()[wall.wall];
    range = wall.range_m;
    found = Surface{range, direction_of(met), met.material};
  }
  for (const Wall& door : closed_doors_) {
    const double at = hit(origin, direction, door);
    if (at >= range) continue;
    range = at;
    found = Surface{at, direction_of(door), Material::kOpaque};
  }
  for (const Cylinder& person : people_) {
    const double at = hit(origin, direction, person);
    if (at >= range) continue;
    range = at;
    found = Surface{at, {-direction.y, direction.x}, Material::kOpaque};  // clothes return at any angle
  }
  return found;
}

std::optional<BeamCaster::Return> BeamCaster::cast(const Point2& origin, double angle_rad, double max_range_m,
                                                   double mesh_draw) const {
  Point2 at = origin;
  Point2 direction{std::cos(angle_rad), std::sin(angle_rad)};
  double travelled = 0.0;
  int mirrors = 0;
  for (int surface = 0; surface < kMostSurfaces && travelled < max_range_m; ++surface) {
    const auto met = nearest(at, direction, max_range_m - travelled);
    if (!met) return std::nullopt;
    const double incidence = std::acos(std::min(1.0, std::abs(cross(direction, met->along))));
    const bool is_mirror = met->material == Material::kMirror;
    const bool returns = met->material == Material::kOpaque ||
                         (met->material == Material::kGlass && incidence <= kGlassReturns_rad) ||
                         (met->material == Material::kMesh && mesh_draw < kMeshReturns);
    if (returns) return Return{travelled + met->range_m, incidence};
    if (is_mirror && ++mirrors > kMostMirrors) return std::nullopt;
    at = {at.x + met->range_m * direction.x, at.y + met->range_m * direction.y};
    if (is_mirror) direction = reflected(direction, met->along);
    at = {at.x + kPassed_m * direction.x, at.y + kPassed_m * direction.y};
    travelled += met->range_m + kPassed_m;
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
  const BeamCaster caster(world, walls, people, to_seconds(measured));
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
