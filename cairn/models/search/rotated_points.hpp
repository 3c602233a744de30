#pragma once

#include "cairn/core/pose2.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace cairn {

/// End points of beams turned to every heading of a lattice, in whole cells from the robot's cell; and, level
/// by level, the boxes of cells that they reach while the heading runs over 2^level neighbours.
class RotatedPoints {
 public:
  /// Cells that one point reaches, from the robot's cell: lower left corner and longer side.
  struct Reach {
    std::int16_t column;
    std::int16_t row;
    std::int16_t side;
  };

  /// @param points in the base frame, in cells, each within 16 000 cells
  /// @param headings a multiple of 2^(levels - 1)
  RotatedPoints(std::span<const Point2> points, int headings, int levels);

  std::size_t points() const { return points_; }
  int headings(int level) const { return headings_ >> level; }
  double heading_step_rad() const { return step_rad_; }
  /// All points' reaches for group `heading` of a level.
  std::span<const Reach> at(int level, int heading) const {
    return std::span(levels_[static_cast<std::size_t>(level)])
        .subspan(static_cast<std::size_t>(heading) * points_, points_);
  }

 private:
  void turn(std::span<const Point2> points);
  void join(std::size_t level);

  std::size_t points_;
  int headings_;
  double step_rad_;
  std::vector<std::vector<Reach>> levels_;
};

}  // namespace cairn
