#pragma once

#include "cairn/core/pose2.hpp"
#include "cairn/maps/occupancy_grid.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cairn {

/// Place and size of the cells of an NDT map. Four layers of square cells cover the same ground, layer l
/// shifted by half a cell to the left where l is odd, and by half a cell down where l > 1: every point lies
/// in 2^d = 4 cells, so that no border of a cell is a border of the map (Biber & Strasser, "The Normal
/// Distributions Transform", IROS 2003).
struct NdtGeometry {
  static constexpr int kLayers = 4;

  Pose2 T_map_ndt;
  double cell_size_m = 0.5;
  int columns = 0;  ///< of each layer
  int rows = 0;

  std::size_t size() const {
    return static_cast<std::size_t>(kLayers) * static_cast<std::size_t>(columns) *
           static_cast<std::size_t>(rows);
  }
  /// Index of the cell of `layer` that holds `p_ndt` (metres in the map's own frame); -1 outside, and for
  /// what is not finite.
  std::ptrdiff_t index(int layer, const Point2& p_ndt) const {
    const double column = p_ndt.x / cell_size_m + 0.5 * (layer & 1);
    const double row = p_ndt.y / cell_size_m + 0.5 * (layer >> 1);
    if (!(column >= 0.0 && column < columns && row >= 0.0 && row < rows)) return -1;
    return (static_cast<std::ptrdiff_t>(layer) * rows + static_cast<std::ptrdiff_t>(row)) * columns +
           static_cast<std::ptrdiff_t>(column);
  }
};

/// A normal distribution of the wall in one cell, in the map's own frame, metres.
struct NdtCell {
  std::uint32_t index = 0;  ///< NdtGeometry::index
  double points = 0.0;      ///< that it was made of
  Point2 mean = {};
  double xx = 0.0, xy = 0.0, yy = 0.0;  ///< covariance
  double occupancy = 1.0;  ///< share of the beams into or through the distribution that ended there, 0..1
};

/// The walls of a place as normal distributions: with the occupancies, an ONDT map (Schulz, Hanten & Zell,
/// "Efficient Map Representations for Multi-Dimensional Normal Distributions Transforms", IROS 2018).
class NdtMap {
 public:
  /// @param cells  in the order of their indices
  /// @throws InputError for a cell size outside 0.05..10 m, more than 50 million cells, cells outside the
  ///   geometry or out of order, covariances that are not positive definite, occupancies outside 0..1
  NdtMap(const NdtGeometry& geometry, std::vector<NdtCell> cells);

  const NdtGeometry& geometry() const { return geometry_; }
  const std::vector<NdtCell>& cells() const { return cells_; }

  static constexpr std::int32_t kNone = -1;
  /// Number in cells() of the distributions around a point of the map's own frame; kNone where there is none.
  std::array<std::int32_t, NdtGeometry::kLayers> around(const Point2& p_ndt) const {
    std::array<std::int32_t, NdtGeometry::kLayers> found{};
    for (int layer = 0; layer < NdtGeometry::kLayers; ++layer) {
      const std::ptrdiff_t index = geometry_.index(layer, p_ndt);
      found[static_cast<std::size_t>(layer)] = index < 0 ? kNone : numbers_[static_cast<std::size_t>(index)];
    }
    return found;
  }

 private:
  NdtGeometry geometry_;
  std::vector<NdtCell> cells_;
  std::vector<std::int32_t> numbers_;  ///< per cell of the geometry, its number in cells_
};

struct NdtMapOptions {
  double cell_size_m = 0.5;
  int min_points = 3;  ///< cells with fewer hold no distribution
  /// Standard deviation of the points, added to every covariance: without it a straight wall would be
  /// infinitely thin.
  double noise_m = 0.02;
};

/// A scan and where it was taken.
struct NdtScan {
  Pose2 T_map_sensor;
  std::vector<Point2> end_points;  ///< in the sensor's frame, metres; beams without return left out
};

/// From points of walls, in the map frame, metres; all occupancies are 1.
/// @throws InputError for no point, points that are not finite, or an extent of too many cells
NdtMap ndt_from_points(std::span<const Point2> points_map, const NdtMapOptions& options);

/// From posed scans. A beam that ends in a cell counts for its occupancy; one that passes the distribution
/// within two standard deviations, and ends behind the cell, counts against it.
/// @throws InputError as ndt_from_points
NdtMap ndt_from_scans(std::span<const NdtScan> scans, const NdtMapOptions& options);

/// From the occupied cells of a grid; the occupancy of a distribution is their mean probability. The map's
/// frame is that of the grid.
/// @throws InputError if the grid has no occupied cell
NdtMap ndt_from_grid(const OccupancyGrid& grid, const NdtMapOptions& options);

}  // namespace cairn
