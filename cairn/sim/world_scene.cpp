#include "cairn/sim/world_scene.hpp"

#include "cairn/maps/ray_casting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn {
namespace {

constexpr double kDoorHeight_m = 2.1;

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

// Where a ray comes in: one that begins within a person, having gone through the surface, meets nothing more
// of it.
double hit(const Point2& origin, const Point2& direction, const Cylinder& person) {
  const Point2 to{person.center.x - origin.x, person.center.y - origin.y};
  const double aside = cross(direction, to), ahead = dot(direction, to);
  if (ahead < 0.0 || std::abs(aside) > person.radius_m) return std::numeric_limits<double>::infinity();
  const double entry = ahead - std::sqrt(person.radius_m * person.radius_m - aside * aside);
  return entry >= 0.0 ? entry : std::numeric_limits<double>::infinity();
}

}  // namespace

WorldScene::WorldScene(const World& world, const WallGrid& walls, const People& people, double time_s)
    : world_(world), walls_(walls), ceiling_m_(world.options.ceiling.height_m), people_(people.at(time_s)) {
  for (const WorldDoor& door : world.doors) {
    if (door.is_closed(time_s)) closed_doors_.push_back(door.leaf);
  }
}

double WorldScene::Surface::incidence_rad(const Point2& direction) const {
  return std::acos(std::min(1.0, std::abs(cross(direction, along))));
}

std::optional<WorldScene::Surface> WorldScene::nearest(const Point2& origin, const Point2& direction,
                                                       double max_range_m) const {
  std::optional<Surface> found;
  double range = max_range_m;
  if (const RayHit wall = cast_ray(walls_, origin, direction, max_range_m)) {
    const Wall& met = walls_.map().walls()[wall.wall];
    range = wall.range_m;
    found = Surface{range, direction_of(met), met.material, Thing::kWall, world_.spans[wall.wall]};
  }
  for (const Wall& door : closed_doors_) {
    const double at = hit(origin, direction, door);
    if (at >= range) continue;
    range = at;
    found = Surface{at, direction_of(door), Material::kOpaque, Thing::kDoor, {0.0, kDoorHeight_m}};
  }
  for (const Cylinder& person : people_) {
    const double at = hit(origin, direction, person);
    if (at >= range) continue;
    range = at;
    const HeightSpan span{0.0, world_.options.people.height_m};
    found = Surface{at, {-direction.y, direction.x}, Material::kOpaque, Thing::kPerson, span};
  }
  return found;
}

}  // namespace cairn
