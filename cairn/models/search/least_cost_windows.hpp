#pragma once

#include "cairn/maps/distance_field.hpp"
#include "cairn/models/sensor/likelihood_field.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace cairn {

/// Rectangle of cells of a grid: columns [first_column, first_column + columns), rows likewise.
struct CellBox {
  int first_column = 0;
  int first_row = 0;
  int columns = 0;
  int rows = 0;
};

/// What an end point of a beam costs in each cell of a map, and the least cost within square windows of
/// cells: the planes from which a search takes its bounds.
///
/// The cost is -log(z_hit exp(-d^2 / (2 sigma_hit^2)) + z_rand) less the smallest value that it can take, so
/// that 0 is a point on a wall; d is the distance to the nearest occupied cell. Window costs are rounded down
/// to 1/255 of the largest cost, so that a window never costs more than any of its cells.
class LeastCostWindows {
 public:
  /// @param largest_window cells along a side; at least 1
  /// @param box cells outside cost as much as those far from every wall
  LeastCostWindows(const DistanceField& field, const LikelihoodFieldOptions& model, const CellBox& box,
                   int largest_window);

  /// One plane: least cost, in steps, of the windows of `size` x `size` cells by their lower left cell.
  class Plane {
   public:
    Plane(int columns, int rows, int size);
    int size() const { return size_; }
    /// Any integers: a window off the map costs the most.
    std::uint8_t at(int column, int row) const {
      const int c = std::clamp(column, -size_, columns_) + size_;
      const int r = std::clamp(row, -size_, rows_) + size_;
      return steps_[static_cast<std::size_t>(r) * stride_ + static_cast<std::size_t>(c)];
    }

   private:
    friend class LeastCostWindows;
    std::uint8_t& cell(int column, int row) {
      return steps_[static_cast<std::size_t>(row + size_) * stride_ +
                    static_cast<std::size_t>(column + size_)];
    }
    int columns_;
    int rows_;
    int size_;
    std::size_t stride_;
    std::vector<std::uint8_t> steps_;
  };

  /// Index of the smallest plane whose windows hold `size` cells along a side; planes() if there is none.
  std::size_t plane_for(int size) const;
  std::size_t planes() const { return planes_.size(); }
  const Plane& plane(std::size_t index) const { return planes_[index]; }

  /// Exact cost of an end point in a cell, counted from the box's first cell; any integers.
  double cost(int column, int row) const;
  double cost_per_step() const { return cost_per_step_; }
  /// -log of the likelihood of a point on a wall: what cost 0 stands for.
  double least() const { return least_; }

 private:
  Plane quantised() const;
  Plane pooled(const Plane& smaller, int size) const;

  CellBox box_;
  double least_;
  double cost_per_step_;
  float far_;
  std::vector<float> costs_;
  std::vector<Plane> planes_;
};

}  // namespace cairn
