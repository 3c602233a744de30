#pragma once

#include "cairn/maps/wall_grid.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace cairn {

/// A number that grows with the angle of a direction like the angle itself, without trigonometry: 0 at -45
/// degrees, 2 at 45, 4 at 135, 6 at 225, up to (excluding) 8. NaN for a direction that is none.
double turn_of(const Point2& direction);

/// Piece of a wall that is seen from a point, from its right to its left end (counter-clockwise).
struct VisiblePiece {
  double turn_begin = 0.0, turn_end = 0.0;  ///< turn_of() the ends, seen from the viewpoint
  Point2 begin, end;                        ///< map frame, metres
  std::uint32_t wall = kNoWall;             ///< index in VectorMap::walls()
};

/// Renders what a point sees: the exact visible pieces of the walls, hidden parts removed.
///
/// The view is cut into four sectors of 90 degrees around the axes. In a sector with the axis along x, a wall
/// is a straight line over the slope s = y/x if its nearness w = 1/x is drawn over it, so that what is seen
/// is the upper envelope of straight lines. Only walls in cells that are not yet hidden are looked at, column
/// by column away from the viewpoint: the work grows with the area that is seen, not with the map. Hence the
/// choice of walls is cautious, and the envelope of those chosen exact.
///
/// Holds scratch memory: one renderer per thread. The grid must outlive it.
class VisibilityRenderer {
 public:
  explicit VisibilityRenderer(const WallGrid& grid);

  /// The pieces in the order of turn_begin, within the square of half width `reach_m` around the viewpoint.
  /// Neighbouring pieces may belong to the same wall (at the diagonals, and at `reach_m`). Walls that are
  /// seen edge-on, and the first micrometre around the viewpoint, are not seen. Empty if the viewpoint is not
  /// finite. Valid until the next call.
  const std::vector<VisiblePiece>& render(const Point2& viewpoint, double reach_m);

 private:
  static constexpr int kBuckets = 64;  // of slope, per sector

  /// A wall in a sector: nearness over slope, a straight line.
  struct Line {
    double s0, s1, w0, w1;
    std::uint32_t wall;
    double at(double s) const { return w0 + (s - s0) * gain; }
    double gain;
  };
  /// Part of a line that is not hidden by another.
  struct Span {
    double s0, s1;
    std::uint32_t line;
  };
  /// How far a bucket of slopes is known to be closed by the walls seen so far.
  struct Bucket {
    double closed_w;          ///< walls that close all of it are nearer than 1 / closed_w; 0: none does
    double left_s, left_w;    ///< a wall covers from its lower edge to left_s
    double right_s, right_w;  ///< a wall covers from right_s to its upper edge
  };

  void sweep(int sector, double reach_m);
  void visit_column(int sector, int column, double near, double far);
  void visit_cell(int sector, int column, int row);
  void take(int sector, const WallInCell& wall);
  void close_buckets(const Line& line);
  void insert(std::uint32_t line);
  bool is_hidden(const Line& line, std::size_t first) const;
  void put_pieces(int sector);

  const WallGrid& grid_;
  Point2 viewpoint_;
  double least_w_ = 0.0;
  std::vector<std::uint32_t> seen_in_;  ///< per wall, the pass that looked at it last
  std::uint32_t pass_ = 0;
  std::uint64_t open_ = 0;
  std::array<Bucket, kBuckets> buckets_;
  std::vector<Line> lines_;
  std::vector<Span> envelope_, replacement_;
  std::vector<VisiblePiece> pieces_;
};

}  // namespace cairn
