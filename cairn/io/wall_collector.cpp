#include "cairn/io/wall_collector.hpp"

#include "cairn/core/errors.hpp"

#include <cmath>

namespace cairn {

void WallCollector::add(const Wall& wall, const std::string& where) {
  for (const double v : {wall.a.x, wall.a.y, wall.b.x, wall.b.y}) {
    if (std::abs(v) <= VectorMap::kMaxCoordinate_m) continue;
    throw InputError(where, "the coordinate is not finite or beyond 10,000 km",
                     "give map coordinates in metres");
  }
  if (wall.a == wall.b) {
    diagnostics_.warn("zero-length segment", where, "left out");
    return;
  }
  if (walls_.size() == VectorMap::kMaxWalls) {
    throw InputError(where, "more than 5 million walls", "cut the map into smaller ones");
  }
  walls_.push_back(wall);
}

VectorMap WallCollector::finish() {
  if (walls_.empty()) {
    throw InputError(name_, "holds no wall", "give a map with at least one segment of non-zero length");
  }
  return VectorMap(std::move(walls_));
}

}  // namespace cairn
