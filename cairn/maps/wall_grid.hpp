#pragma once

#include "cairn/maps/vector_map.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace cairn {

inline constexpr std::uint32_t kNoWall = 0xffffffff;

/// End points of a wall, copied into the cells that it touches.
struct WallInCell {
  Point2 a;
  Point2 b;
  std::uint32_t wall;  ///< index in VectorMap::walls()
};

/// Uniform grid over the walls of a map that a sensor sees: which walls touch which cell.
///
/// Every cell lists every wall that comes within a nanometre of it (a hundredth of a micrometre at 1000 km),
/// so that what was rounded into the neighbouring cell is still found. At most 4 million cells; memory grows
/// with the number of walls and cells only.
class WallGrid {
 public:
  /// @param cell_m  0: chosen from the number of walls and their length; larger where the limits ask for it
  explicit WallGrid(std::shared_ptr<const VectorMap> map, MaterialSet seen = kSeenByLaser,
                    double cell_m = 0.0);

  const VectorMap& map() const { return *map_; }
  const std::shared_ptr<const VectorMap>& shared_map() const { return map_; }
  const Point2& origin() const { return origin_; }  ///< outer corner of cell (0, 0)
  double cell_m() const { return cell_m_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }

  std::span<const WallInCell> cell(int column, int row) const {
    const std::size_t i =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
    return {entries_.data() + first_[i], first_[i + 1] - first_[i]};
  }

 private:
  void choose_cells(const std::vector<std::uint32_t>& seen, double cell_m);
  void fill(const std::vector<std::uint32_t>& seen);
  template <class Visit>
  void for_each_cell(const Wall& wall, const Visit& visit) const;

  std::shared_ptr<const VectorMap> map_;
  Point2 origin_;
  double cell_m_ = 1.0;
  double slack_m_ = 0.0;
  int columns_ = 0, rows_ = 0;
  std::vector<std::uint32_t> first_;  ///< of each cell, in entries_
  std::vector<WallInCell> entries_;
};

}  // namespace cairn
