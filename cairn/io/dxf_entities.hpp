#pragma once

#include "cairn/core/pose2.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace cairn {

/// Straight or bent piece of a drawing, in the units and axes of the drawing or of the block that holds it.
/// Bulge = tan(angle of the arc / 4), positive counter-clockwise; 0: straight.
struct DxfPiece {
  Point2 a, b;
  double bulge = 0.0;
  std::uint32_t layer = 0;  ///< index of a name
  int line = 0;             ///< in the file
};

/// Insertion of a block: p -> position + R(turn) (scale * (p - base)), once per row and column.
struct DxfInsert {
  std::string block;
  Point2 position;
  double scale_x = 1.0, scale_y = 1.0;
  double turn_rad = 0.0;
  long long columns = 1, rows = 1;
  double column_spacing = 0.0, row_spacing = 0.0;
  std::uint32_t layer = 0;
  int line = 0;
};

/// What a block, or the drawing itself, consists of.
struct DxfBlock {
  Point2 base;
  std::vector<DxfPiece> pieces;
  std::vector<DxfInsert> inserts;
};

/// Circles and arcs as two pieces and one; angles in degrees, counter-clockwise.
void add_circle(const Point2& center, double radius, const DxfPiece& like, std::vector<DxfPiece>& pieces);
void add_arc(const Point2& center, double radius, double from_deg, double to_deg, const DxfPiece& like,
             std::vector<DxfPiece>& pieces);

}  // namespace cairn
