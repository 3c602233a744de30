#include "cairn/io/dxf_entities.hpp"

#include "cairn/core/angle.hpp"

#include <cmath>

namespace cairn {

void add_circle(const Point2& center, double radius, const DxfPiece& like, std::vector<DxfPiece>& pieces) {
  add_arc(center, radius, 0.0, 180.0, like, pieces);
  add_arc(center, radius, 180.0, 360.0, like, pieces);
}

void add_arc(const Point2& center, double radius, double from_deg, double to_deg, const DxfPiece& like,
             std::vector<DxfPiece>& pieces) {
  double sweep = std::fmod(to_deg - from_deg, 360.0);
  if (sweep <= 0.0) sweep += 360.0;
  if (sweep > 270.0) {  // a bulge near infinity has no accuracy: two halves
    add_arc(center, radius, from_deg, from_deg + 0.5 * sweep, like, pieces);
    add_arc(center, radius, from_deg + 0.5 * sweep, from_deg + sweep, like, pieces);
    return;
  }
  const double from = from_deg * kPi / 180.0, angle = sweep * kPi / 180.0;
  DxfPiece piece = like;
  piece.a = {center.x + radius * std::cos(from), center.y + radius * std::sin(from)};
  piece.b = {center.x + radius * std::cos(from + angle), center.y + radius * std::sin(from + angle)};
  piece.bulge = std::tan(angle / 4.0);
  pieces.push_back(piece);
}

}  // namespace cairn
