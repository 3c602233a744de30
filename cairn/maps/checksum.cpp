#include "cairn/maps/checksum.hpp"

#include <bit>

namespace cairn {
namespace {

class Fnv1a {
 public:
  void add_byte(std::uint8_t byte) { hash_ = (hash_ ^ byte) * 0x100000001b3u; }
  void add(std::uint64_t value) {
    for (int shift = 0; shift < 64; shift += 8) add_byte(static_cast<std::uint8_t>(value >> shift));
  }
  // -0.0 and 0.0 are the same place.
  void add(double value) { add(std::bit_cast<std::uint64_t>(value + 0.0)); }
  std::uint64_t hash() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

}  // namespace

std::uint64_t checksum(const OccupancyGrid& grid) {
  const GridGeometry& geometry = grid.geometry();
  Fnv1a fnv;
  fnv.add(static_cast<std::uint64_t>(geometry.width));
  fnv.add(static_cast<std::uint64_t>(geometry.height));
  fnv.add(geometry.resolution_m);
  fnv.add(geometry.T_map_grid.x);
  fnv.add(geometry.T_map_grid.y);
  fnv.add(geometry.T_map_grid.theta);
  for (std::size_t i = 0; i < geometry.size(); ++i) fnv.add_byte(static_cast<std::uint8_t>(grid.state(i)));
  return fnv.hash();
}

std::uint64_t checksum(const VectorMap& map) {
  Fnv1a fnv;
  for (const Wall& wall : map.walls()) {
    for (const double v : {wall.a.x, wall.a.y, wall.b.x, wall.b.y}) fnv.add(v);
    fnv.add_byte(static_cast<std::uint8_t>(wall.material));
  }
  return fnv.hash();
}

std::uint64_t checksum(const NdtMap& map) {
  Fnv1a fnv;
  const NdtGeometry& geometry = map.geometry();
  for (const double v : {geometry.cell_size_m, geometry.T_map_ndt.x, geometry.T_map_ndt.y,
                         geometry.T_map_ndt.theta, static_cast<double>(geometry.columns)})
    fnv.add(v);
  for (const NdtCell& cell : map.cells()) {
    fnv.add(std::uint64_t{cell.index});
    for (const double v : {cell.mean.x, cell.mean.y, cell.xx, cell.xy, cell.yy, cell.occupancy}) fnv.add(v);
  }
  return fnv.hash();
}

std::uint64_t checksum(const MapSet& maps) {
  const std::uint64_t grid = checksum(*maps.grid());
  const auto walls = maps.find<VectorMap>();
  const auto ndt = maps.find<NdtMap>();
  if (!walls && !ndt) return grid;
  Fnv1a fnv;
  fnv.add(grid);
  if (walls) fnv.add(checksum(*walls));
  if (ndt) fnv.add(checksum(*ndt));
  return fnv.hash();
}

}  // namespace cairn
