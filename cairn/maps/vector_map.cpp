#include "cairn/maps/vector_map.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace cairn {
namespace {

constexpr std::array<std::string_view, 4> kNames = {"opaque", "glass", "mesh", "mirror"};

bool is_usable(const Point2& p) {
  return std::abs(p.x) <= VectorMap::kMaxCoordinate_m && std::abs(p.y) <= VectorMap::kMaxCoordinate_m;
}

void check(const Wall& wall, std::size_t index) {
  const std::string where = "wall " + std::to_string(index);
  if (!is_usable(wall.a) || !is_usable(wall.b)) {
    throw InputError(where, "has a coordinate that is not finite or beyond 10,000 km",
                     "give map coordinates in metres");
  }
  if (wall.a == wall.b) throw InputError(where, "has no length", "leave it out");
}

}  // namespace

std::string_view name_of(Material material) { return kNames[static_cast<std::size_t>(material)]; }

Material material_named(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) {
    throw InputError("material", "'" + std::string(name) + "' is not known",
                     "use opaque, glass, mesh or mirror");
  }
  return static_cast<Material>(found - kNames.begin());
}

VectorMap::VectorMap(std::vector<Wall> walls) : walls_(std::move(walls)) {
  if (walls_.empty()) throw InputError("vector map", "has no wall", "give at least one segment");
  if (walls_.size() > kMaxWalls) {
    throw InputError("vector map", "has more than 5 million walls", "cut it into smaller maps");
  }
  bounds_ = {walls_.front().a, walls_.front().a};
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    const Wall& w = walls_[i];
    check(w, i);
    bounds_.min = {std::min({bounds_.min.x, w.a.x, w.b.x}), std::min({bounds_.min.y, w.a.y, w.b.y})};
    bounds_.max = {std::max({bounds_.max.x, w.a.x, w.b.x}), std::max({bounds_.max.y, w.a.y, w.b.y})};
    length_m_ += std::hypot(w.b.x - w.a.x, w.b.y - w.a.y);
  }
}

std::size_t VectorMap::count(Material material) const {
  return static_cast<std::size_t>(
      std::count_if(walls_.begin(), walls_.end(), [&](const Wall& w) { return w.material == material; }));
}

double distance(const Point2& point, const Wall& wall) {
  const double dx = wall.b.x - wall.a.x, dy = wall.b.y - wall.a.y;
  const double px = point.x - wall.a.x, py = point.y - wall.a.y;
  const double along = std::clamp((px * dx + py * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return std::hypot(px - along * dx, py - along * dy);
}

}  // namespace cairn
