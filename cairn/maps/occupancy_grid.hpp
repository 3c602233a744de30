#pragma once

#include "cairn/core/pose2.hpp"

#include <cstdint>
#include <vector>

namespace cairn {

/// Size and place of a grid of square cells.
///
/// Cell (column, row) covers [column, column+1) x [row, row+1) times `resolution_m` in the grid's own frame,
/// whose origin (the outer corner of cell (0, 0)) lies at `T_map_grid` in the map: rows count upwards along
/// y.
struct GridGeometry {
  int width = 0;   ///< columns
  int height = 0;  ///< rows
  double resolution_m = 0.0;
  Pose2 T_map_grid;

  std::size_t size() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  bool contains(int column, int row) const {
    return column >= 0 && column < width && row >= 0 && row < height;
  }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
  }
  /// Centre of a cell in the map frame.
  Point2 center(int column, int row) const;
  /// Point of the map in cell units of the grid (floor gives column and row).
  Point2 to_cells(const Point2& p_map) const;

  friend bool operator==(const GridGeometry&, const GridGeometry&) = default;
};

enum class CellState : std::uint8_t { kFree, kOccupied, kUnknown };

/// Immutable map of square cells, each free, occupied or unknown, with its probability of being occupied.
class OccupancyGrid {
 public:
  /// Percent occupied, 0..100; kUnknown where nothing was seen (the convention of nav_msgs/OccupancyGrid).
  using Cell = std::int8_t;
  static constexpr Cell kUnknown = -1;

  /// Thresholds on the probability (map_server's meaning and defaults): occupied above the first, free below
  /// the second, unknown between.
  struct Thresholds {
    double occupied = 0.65;
    double free = 0.25;  ///< map_server's value is 0.196 in ROS 1, 0.25 in ROS 2
  };

  /// @param cells row by row from the bottom, `geometry.size()` of them, each kUnknown or 0..100.
  /// @throws InputError for a geometry that is not finite and positive or cells that do not fit it.
  OccupancyGrid(GridGeometry geometry, std::vector<Cell> cells, Thresholds thresholds);
  OccupancyGrid(GridGeometry geometry, std::vector<Cell> cells)
      : OccupancyGrid(geometry, std::move(cells), Thresholds{}) {}

  const GridGeometry& geometry() const { return geometry_; }
  const std::vector<Cell>& cells() const { return cells_; }
  const Thresholds& thresholds() const { return thresholds_; }

  CellState state(std::size_t index) const;
  /// kUnknown outside the grid.
  CellState state_at(const Point2& p_map) const;
  std::size_t count(CellState state) const;

 private:
  GridGeometry geometry_;
  std::vector<Cell> cells_;
  Thresholds thresholds_;
};

}  // namespace cairn
