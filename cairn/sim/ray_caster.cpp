#include "cairn/sim/ray_caster.hpp"

#include <cmath>
#include <limits>

namespace cairn {
namespace {

constexpr double kMiss = std::numeric_limits<double>::infinity();
// Neighbouring walls share a corner: a ray through it must not slip between them for a rounding error.
constexpr double kCornerTolerance = 1e-9;

struct Ray {
  Point2 origin;
  Point2 direction;  // of length one
};

double cross(const Point2& a, const Point2& b) { return a.x * b.y - a.y * b.x; }
Point2 minus(const Point2& a, const Point2& b) { return {a.x - b.x, a.y - b.y}; }

double hit(const Ray& ray, const Segment& wall) {
  const Point2 edge = minus(wall.b, wall.a);
  const Point2 to_wall = minus(wall.a, ray.origin);
  const double denominator = cross(ray.direction, edge);
  if (denominator == 0.0) return kMiss;  // parallel: seen edge-on, without width
  const double along_wall = cross(to_wall, ray.direction) / denominator;
  const double range = cross(to_wall, edge) / denominator;
  const bool on_wall = along_wall >= -kCornerTolerance && along_wall <= 1.0 + kCornerTolerance;
  return on_wall && range >= 0.0 ? range : kMiss;
}

double hit(const Ray& ray, const Cylinder& cylinder) {
  const Point2 to_center = minus(cylinder.center, ray.origin);
  const double r = cylinder.radius_m;
  if (std::hypot(to_center.x, to_center.y) <= r) return 0.0;
  const double along = to_center.x * ray.direction.x + to_center.y * ray.direction.y;
  const double aside = cross(ray.direction, to_center);
  if (along < 0.0 || std::abs(aside) > r) return kMiss;
  return along - std::sqrt(r * r - aside * aside);
}

}  // namespace

std::optional<double> cast_ray(const FloorPlan& plan, const Pose2& pose) {
  const Ray ray{{pose.x, pose.y}, {std::cos(pose.theta), std::sin(pose.theta)}};
  double nearest = kMiss;
  for (const Segment& wall : plan.walls) nearest = std::fmin(nearest, hit(ray, wall));
  for (const Cylinder& cylinder : plan.cylinders) nearest = std::fmin(nearest, hit(ray, cylinder));
  return nearest < kMiss ? std::optional(nearest) : std::nullopt;
}

}  // namespace cairn
