#pragma once

#include "cairn/maps/wall_grid.hpp"
#include "cairn/sim/people.hpp"
#include "cairn/sim/world.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace cairn {

/// Everything that stands in a world at one instant: walls, furniture, closed doors and people, each upright
/// and of a certain height.
class WorldScene {
 public:
  /// @param walls  of world.solid, for all materials
  WorldScene(const World& world, const WallGrid& walls, const People& people, double time_s);

  enum class Thing : std::uint8_t { kWall, kDoor, kPerson };

  /// What a horizontal ray meets.
  struct Surface {
    double range_m = 0.0;
    Point2 along;  ///< unit vector along the surface; of a person across the ray: clothes return at any angle
    Material material = Material::kOpaque;
    Thing thing = Thing::kWall;
    HeightSpan span;

    /// Between the ray and the surface's normal, 0..pi/2.
    double incidence_rad(const Point2& direction) const;
  };

  /// The first surface on a ray, of whatever height.
  /// @param direction  of unit length
  std::optional<Surface> nearest(const Point2& origin, const Point2& direction, double max_range_m) const;

  /// Calls `visit(surface)` for the surfaces between two points, nearest first, until it returns false.
  template <class Visit>
  void visit_between(const Point2& from, const Point2& to, const Visit& visit) const;

  double ceiling_m() const { return ceiling_m_; }

  static constexpr double kPassed_m = 1e-6;  ///< beyond a surface that let the ray through
  static constexpr int kMostSurfaces = 64;

 private:
  const World& world_;
  const WallGrid& walls_;
  double ceiling_m_;
  std::vector<Wall> closed_doors_;
  std::vector<Cylinder> people_;
};

/// The direction after a mirror.
inline Point2 reflected(const Point2& direction, const Point2& along) {
  const double s = 2.0 * (direction.x * along.x + direction.y * along.y);
  return {s * along.x - direction.x, s * along.y - direction.y};
}

template <class Visit>
void WorldScene::visit_between(const Point2& from, const Point2& to, const Visit& visit) const {
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  if (length <= kPassed_m) return;
  const Point2 direction{(to.x - from.x) / length, (to.y - from.y) / length};
  double travelled = 0.0;
  for (int i = 0; i < kMostSurfaces; ++i) {
    const Point2 at{from.x + travelled * direction.x, from.y + travelled * direction.y};
    auto met = nearest(at, direction, length - travelled);
    if (!met) return;
    met->range_m += travelled;
    // Whatever hangs on a wall is not behind it.
    if (met->range_m > length - 1e-3 || !visit(*met)) return;
    travelled = met->range_m + kPassed_m;
  }
}

}  // namespace cairn
