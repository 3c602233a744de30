#pragma once

#include "cairn/core/large_vector.hpp"
#include "cairn/maps/distance_field.hpp"
#include "cairn/models/search/block_sums.hpp"
#include "cairn/models/sensor/likelihood_field.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
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
///
/// A search divides boxes of poses by four along each side. Boxes of one tier are 4^tier cells apart; the
/// windows that 4 x 4 of them ask for lie side by side in memory.
class LeastCostWindows {
 public:
  static constexpr int kTiers = 4;
  /// Cells along the largest windows: a point that reaches farther has no bound.
  static constexpr int kLargest = 128;
  /// Cells from a box of this tier to the next, and along its side.
  static constexpr int stride(int tier) { return 1 << (2 * tier); }

  /// @param box cells outside cost as much as those far from every wall
  LeastCostWindows(const DistanceField& field, const LikelihoodFieldOptions& model, const CellBox& box);

  /// Least cost, in steps, of the windows of `size` x `size` cells by their lower left cell.
  class Plane {
   public:
    int size() const { return size_; }
    /// Any integers: a window off the map costs the most.
    std::uint8_t at(int column, int row) const { return block(column, row).at(0, 0); }
    /// The windows at (column + j stride, row + i stride), i and j from 0 to 3, as place (j, i). Any
    /// integers.
    BlockPlace block(int column, int row) const {
      const int from_left = std::clamp(column, -margin_, columns_) + margin_;
      const int from_below = std::clamp(row, -margin_, rows_) + margin_;
      const auto c = static_cast<std::size_t>(from_left), r = static_cast<std::size_t>(from_below);
      const std::size_t within = (std::size_t{1} << shift_) - 1;
      const std::size_t phase = ((r & within) << shift_) + (c & within);
      const std::size_t place = r >> shift_;
      return {steps_.data() + phase * phase_size_ + place / 4 * row_step_ + 4 * (c >> shift_), row_step_,
              static_cast<unsigned>(place % 4)};
    }

   private:
    friend class LeastCostWindows;
    int size_ = 0;
    int columns_ = 0;
    int rows_ = 0;
    int margin_ = 0;            ///< of columns and rows whose blocks are off the map
    int shift_ = 0;             ///< log2 of the stride
    std::size_t row_step_ = 0;  ///< of four rows, see BlockPlace
    std::size_t phase_size_ = 0;
    LargeVector<std::uint8_t> steps_;
  };

  /// The planes of a tier, the smallest windows first.
  const std::vector<Plane>& planes(int tier) const { return tiers_[static_cast<std::size_t>(tier)]; }
  /// That of the smallest windows that hold `size` cells along a side; nullptr if there is none.
  const Plane* plane_for(int tier, int size) const;

  /// Exact cost of an end point in a cell, counted from the box's first cell; any integers.
  double cost(int column, int row) const;
  double cost_per_step() const { return cost_per_step_; }
  /// -log of the likelihood of a point on a wall: what cost 0 stands for.
  double least() const { return least_; }

 private:
  /// Steps of windows row by row, with the margin that the largest of them need.
  struct Windows {
    int size;
    LargeVector<std::uint8_t> steps;
  };

  std::size_t place(int column, int row) const;
  Windows quantised() const;
  Windows pooled(const Windows& smaller, int size) const;
  Plane in_order(const Windows& windows, int tier) const;

  CellBox box_;
  double least_;
  double cost_per_step_;
  float far_;
  LargeVector<float> costs_;
  std::array<std::vector<Plane>, kTiers> tiers_;
};

}  // namespace cairn
