#include "cairn/io/dxf.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/dxf_parser.hpp"
#include "cairn/io/wall_collector.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace cairn {
namespace {

constexpr int kMaxDepth = 16;
constexpr long long kMaxInsertions = 1'000'000;
constexpr std::string_view kBinaryStart = "AutoCAD Binary DXF";

// Metres per unit by $INSUNITS: inch, foot, mile, mm, cm, m, km, microinch, mil, yard, angstrom, nm, um, dm,
// dam, hm, Gm, astronomical unit, light year, parsec, US survey foot.
constexpr double kUnits[] = {0,
                             0.0254,
                             0.3048,
                             1609.344,
                             1e-3,
                             1e-2,
                             1,
                             1e3,
                             2.54e-8,
                             2.54e-5,
                             0.9144,
                             1e-10,
                             1e-9,
                             1e-6,
                             0.1,
                             10,
                             100,
                             1e9,
                             1.495978707e11,
                             9.4607304725808e15,
                             3.0856775814913673e16,
                             1200.0 / 3937.0};

// p -> (m00 p.x + m01 p.y + x, m10 p.x + m11 p.y + y)
struct Affine {
  double m00 = 1, m01 = 0, m10 = 0, m11 = 1, x = 0, y = 0;

  Point2 operator*(const Point2& p) const { return {m00 * p.x + m01 * p.y + x, m10 * p.x + m11 * p.y + y}; }
  Affine operator*(const Affine& b) const {
    const Point2 t = *this * Point2{b.x, b.y};
    return {m00 * b.m00 + m01 * b.m10,
            m00 * b.m01 + m01 * b.m11,
            m10 * b.m00 + m11 * b.m10,
            m10 * b.m01 + m11 * b.m11,
            t.x,
            t.y};
  }
  /// No length grows by more than this.
  double largest_scale() const { return std::sqrt(m00 * m00 + m01 * m01 + m10 * m10 + m11 * m11); }
};

Affine placement(const DxfInsert& insert, const Point2& base, long long column, long long row) {
  const double c = std::cos(insert.turn_rad), s = std::sin(insert.turn_rad);
  const Affine scaled{insert.scale_x,
                      0,
                      0,
                      insert.scale_y,
                      static_cast<double>(column) * insert.column_spacing - insert.scale_x * base.x,
                      static_cast<double>(row) * insert.row_spacing - insert.scale_y * base.y};
  return Affine{c, -s, s, c, insert.position.x, insert.position.y} * scaled;
}

bool contains_word(std::string name, std::string_view word) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name.find(word) != std::string::npos;
}

Material material_of(const std::string& layer, const DxfOptions& options) {
  const auto named = options.layers.find(layer);
  if (named != options.layers.end()) return named->second;
  for (const Material m : {Material::kGlass, Material::kMesh, Material::kMirror}) {
    if (contains_word(layer, name_of(m))) return m;
  }
  return Material::kOpaque;
}

// Draws the blocks into walls.
class DxfExpansion {
 public:
  DxfExpansion(const DxfDrawing& drawing, const std::string& name, const DxfOptions& options, double unit_m,
               Diagnostics& diagnostics)
      : drawing_(drawing), name_(name), tolerance_m_(options.chord_tolerance_m), walls_(name, diagnostics) {
    for (const std::string& layer : drawing.layers) materials_.push_back(material_of(layer, options));
    draw(drawing.model, {unit_m, 0, 0, unit_m, 0, 0}, 0, 0);
  }

  VectorMap map() { return walls_.finish(); }

 private:
  std::string where(int line) const { return name_ + ":" + std::to_string(line); }

  void draw(const DxfBlock& block, const Affine& T, std::uint32_t layer, int depth) {
    for (const DxfPiece& piece : block.pieces) draw(piece, T, piece.layer == 0 ? layer : piece.layer);
    for (const DxfInsert& insert : block.inserts) {
      draw(insert, T, insert.layer == 0 ? layer : insert.layer, depth);
    }
  }

  void draw(const DxfInsert& insert, const Affine& T, std::uint32_t layer, int depth) {
    const auto found = drawing_.blocks.find(insert.block);
    if (found == drawing_.blocks.end()) {
      throw InputError(where(insert.line),
                       "inserts the block '" + insert.block + "', which the drawing has not",
                       "save the drawing with its blocks");
    }
    if (depth == kMaxDepth) {
      throw InputError(where(insert.line), "blocks are nested more than 16 deep, or in a circle",
                       "flatten them");
    }
    const bool few = insert.columns <= kMaxInsertions && insert.rows <= kMaxInsertions;
    insertions_ += few ? insert.columns * insert.rows : kMaxInsertions + 1;
    if (insertions_ > kMaxInsertions) {
      throw InputError(where(insert.line), "more than a million insertions of blocks",
                       "cut the drawing into smaller ones");
    }
    for (long long row = 0; row < insert.rows; ++row) {
      for (long long column = 0; column < insert.columns; ++column) {
        draw(found->second, T * placement(insert, found->second.base, column, row), layer, depth + 1);
      }
    }
  }

  void draw(const DxfPiece& piece, const Affine& T, std::uint32_t layer) {
    const Material material = materials_[layer];
    const std::string place = where(piece.line);
    if (piece.bulge == 0.0 || piece.a == piece.b)
      return walls_.add({T * piece.a, T * piece.b, material}, place);
    // Arc of angle 4 atan(bulge) from a to b; the centre is left of the chord for a positive bulge below 1.
    const double dx = piece.b.x - piece.a.x, dy = piece.b.y - piece.a.y;
    const double aside = (1.0 - piece.bulge * piece.bulge) / (4.0 * piece.bulge);
    const Point2 center{0.5 * (piece.a.x + piece.b.x) - aside * dy,
                        0.5 * (piece.a.y + piece.b.y) + aside * dx};
    const Point2 from{piece.a.x - center.x, piece.a.y - center.y};
    const double sweep = 4.0 * std::atan(piece.bulge);
    const int chords = chords_of(std::hypot(from.x, from.y) * T.largest_scale(), std::abs(sweep), place);
    Point2 before = T * piece.a;
    for (int i = 1; i <= chords; ++i) {
      const double angle = sweep * i / chords, c = std::cos(angle), s = std::sin(angle);
      const Point2 at{center.x + c * from.x - s * from.y, center.y + s * from.x + c * from.y};
      const Point2 here = T * (i == chords ? piece.b : at);
      walls_.add({before, here, material}, place);
      before = here;
    }
  }

  int chords_of(double radius_m, double sweep, const std::string& place) const {
    if (!(radius_m <= VectorMap::kMaxCoordinate_m)) {
      throw InputError(place, "is an arc with a radius beyond 10,000 km", "draw it straight");
    }
    // The chord of angle a is r (1 - cos(a / 2)) off the arc; at least 8 chords for a full circle.
    const double per_chord =
        2.0 * std::acos(std::max(0.0, 1.0 - tolerance_m_ / std::max(radius_m, tolerance_m_)));
    return static_cast<int>(std::ceil(sweep / std::min(per_chord, 0.25 * kPi) - 1e-9));
  }

  const DxfDrawing& drawing_;
  std::string name_;
  double tolerance_m_;
  WallCollector walls_;
  std::vector<Material> materials_;
  long long insertions_ = 0;
};

double unit_of(const DxfDrawing& drawing, const DxfOptions& options, const std::string& name,
               Diagnostics& diagnostics) {
  if (options.unit_m > 0.0) return options.unit_m;
  constexpr auto kKnown = static_cast<long long>(std::size(kUnits));
  if (drawing.insert_units > 0 && drawing.insert_units < kKnown) return kUnits[drawing.insert_units];
  diagnostics.warn("no unit in the drawing", name, "metres are assumed");
  return 1.0;
}

}  // namespace

VectorMap read_dxf(std::istream& input, const std::string& name, const DxfOptions& options,
                   Diagnostics& diagnostics) {
  if (!(options.unit_m >= 0.0 && options.unit_m <= 1e6 && options.chord_tolerance_m >= 1e-6)) {
    throw ConfigurationError("unit or chord tolerance of a drawing", "is out of range", "give metres");
  }
  if (input.peek() == kBinaryStart.front()) {
    throw InputError(name, "is a binary DXF file", "save the drawing as ASCII DXF");
  }
  const DxfDrawing drawing = parse_dxf(input, name, diagnostics);
  return DxfExpansion(drawing, name, options, unit_of(drawing, options, name, diagnostics), diagnostics)
      .map();
}

bool looks_like_dxf(std::string_view first_bytes) {
  if (first_bytes.substr(0, kBinaryStart.size()) == kBinaryStart) return true;
  std::string words;  // without blanks, which programs indent the codes with
  for (const char c : first_bytes.substr(0, 256)) {
    if (c != ' ' && c != '\t' && c != '\r') words += c;
  }
  return words.rfind("0\nSECTION\n", 0) == 0 || words.rfind("999\n", 0) == 0;
}

}  // namespace cairn
