#include "cairn/io/dxf_parser.hpp"

#include "cairn/io/dxf_groups.hpp"
#include "cairn/maps/vector_map.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>

namespace cairn {
namespace {

// What hangs on others and is no wall by itself.
const std::set<std::string> kSilent = {"SEQEND", "ATTRIB", "ATTDEF"};

struct Vertex {
  Point2 at;
  double bulge = 0.0;
};

// The groups of one entity that any kind of it may use.
struct Entity {
  std::string kind;
  int line = 0;
  std::uint32_t layer = 0;
  std::string block;  ///< 2
  Point2 first, second;
  double values[4] = {};  ///< 40 to 43
  bool has_value[4] = {};
  double angles[2] = {};            ///< 50, 51
  long long flags = 0;              ///< 70
  long long columns = 1, rows = 1;  ///< 70, 71 of an INSERT
  double spacings[2] = {};          ///< 44, 45
  double bulge = 0.0;               ///< 42 of a VERTEX
  double extrusion_z = 1.0;         ///< 230: -1 for what was mirrored
  bool in_paper_space = false;      ///< 67
  std::vector<Vertex> vertices;     ///< of an LWPOLYLINE
};

class DxfParser {
 public:
  DxfParser(std::istream& input, const std::string& name, Diagnostics& diagnostics)
      : groups_(input, name), diagnostics_(diagnostics) {
    layer_of("0");
  }

  DxfDrawing parse() {
    while (groups_.next()) {
      if (groups_.is(0, "EOF")) return std::move(drawing_);
      if (!groups_.is(0, "SECTION")) continue;
      if (!groups_.next() || groups_.code() != 2) groups_.fail("a section has no name", "repair the file");
      const std::string section = groups_.value();
      if (section == "HEADER") {
        header();
      } else if (section == "BLOCKS") {
        blocks();
      } else if (section == "ENTITIES") {
        entities(drawing_.model, "ENDSEC");
      } else {
        skip_section();
      }
    }
    groups_.fail("the file ends before EOF", "it was cut off: copy it again");
  }

 private:
  void need_next() {
    if (!groups_.next()) groups_.fail("the file ends before EOF", "it was cut off: copy it again");
  }

  void skip_section() {
    while (!groups_.is(0, "ENDSEC")) need_next();
  }

  void header() {
    for (need_next(); !groups_.is(0, "ENDSEC"); need_next()) {
      if (!groups_.is(9, "$INSUNITS")) continue;
      need_next();
      drawing_.insert_units = groups_.integer();
    }
  }

  void blocks() {
    need_next();
    while (!groups_.is(0, "ENDSEC")) {
      if (!groups_.is(0, "BLOCK")) {
        need_next();
        continue;
      }
      std::string name;
      DxfBlock block;
      for (need_next(); groups_.code() != 0; need_next()) {
        if (groups_.code() == 2) name = groups_.value();
        if (groups_.code() == 10) block.base.x = coordinate();
        if (groups_.code() == 20) block.base.y = coordinate();
      }
      entities_from_here(block, "ENDBLK");
      drawing_.blocks[name] = std::move(block);
    }
  }

  void entities(DxfBlock& block, const char* end) {
    need_next();
    entities_from_here(block, end);
  }

  // The current group begins an entity, or ends the list.
  void entities_from_here(DxfBlock& block, const char* end) {
    while (!groups_.is(0, end)) {
      if (groups_.code() != 0) {
        need_next();
        continue;
      }
      const Entity entity = read_entity();
      if (entity.kind == "POLYLINE") {
        polyline(entity, block);
      } else if (entity.in_paper_space) {
        diagnostics_.count("paper space");
      } else {
        add(entity, block);
      }
    }
  }

  Entity read_entity() {
    Entity entity;
    entity.kind = groups_.value();
    entity.line = groups_.line_number();
    for (need_next(); groups_.code() != 0; need_next()) read_group(entity);
    return entity;
  }

  double coordinate() const { return groups_.number(); }

  void read_group(Entity& e) {
    const int code = groups_.code();
    const bool light = e.kind == "LWPOLYLINE";
    switch (code) {
      case 2:
        e.block = groups_.value();
        break;
      case 8:
        e.layer = layer_of(groups_.value());
        break;
      case 10:
        e.first.x = coordinate();
        if (light) e.vertices.push_back({{e.first.x, 0.0}, 0.0});
        break;
      case 20:
        e.first.y = coordinate();
        if (light && !e.vertices.empty()) e.vertices.back().at.y = e.first.y;
        break;
      case 11:
        e.second.x = coordinate();
        break;
      case 21:
        e.second.y = coordinate();
        break;
      case 40:
      case 41:
      case 42:
      case 43:
        if (light && code == 42 && !e.vertices.empty()) e.vertices.back().bulge = groups_.number();
        e.values[code - 40] = groups_.number();
        e.has_value[code - 40] = true;
        break;
      case 44:
      case 45:
        e.spacings[code - 44] = groups_.number();
        break;
      case 50:
      case 51:
        e.angles[code - 50] = groups_.number();
        break;
      case 67:
        e.in_paper_space = groups_.integer() != 0;
        break;
      case 70:
        e.flags = groups_.integer();
        break;
      case 71:
        if (e.kind == "INSERT") e.rows = groups_.integer();
        break;
      case 230:
        e.extrusion_z = groups_.number();
        break;
      default:
        break;
    }
  }

  // Mirrored entities tell coordinates seen from below: x counts to the left.
  static void mirror(const Entity& e, std::vector<DxfPiece>& pieces, std::size_t from) {
    if (e.extrusion_z >= 0.0) return;
    for (std::size_t i = from; i < pieces.size(); ++i) {
      pieces[i].a.x = -pieces[i].a.x;
      pieces[i].b.x = -pieces[i].b.x;
      pieces[i].bulge = -pieces[i].bulge;
    }
  }

  void add(const Entity& e, DxfBlock& block) {
    const DxfPiece like{e.first, e.second, 0.0, e.layer, e.line};
    const std::size_t before = block.pieces.size();
    if (e.kind == "LINE") {
      block.pieces.push_back(like);  // in world coordinates whatever the extrusion
    } else if (e.kind == "CIRCLE" || e.kind == "ARC") {
      if (e.kind == "CIRCLE") add_circle(e.first, e.values[0], like, block.pieces);
      if (e.kind == "ARC") add_arc(e.first, e.values[0], e.angles[0], e.angles[1], like, block.pieces);
      mirror(e, block.pieces, before);
    } else if (e.kind == "LWPOLYLINE") {
      add_vertices(e.vertices, (e.flags & 1) != 0, like, block.pieces);
      mirror(e, block.pieces, before);
    } else if (e.kind == "INSERT") {
      add_insert(e, block);
    } else if (kSilent.count(e.kind) == 0) {
      diagnostics_.count("entity without walls: " + e.kind.substr(0, 32));
    }
    check_size(block);
  }

  void add_insert(const Entity& e, DxfBlock& block) {
    const double mirrored = e.extrusion_z < 0.0 ? -1.0 : 1.0;
    DxfInsert insert;
    insert.block = e.block;
    insert.position = {mirrored * e.first.x, e.first.y};
    // Mirroring x after turning is turning the other way after mirroring x.
    insert.scale_x = mirrored * (e.has_value[1] ? e.values[1] : 1.0);
    insert.scale_y = e.has_value[2] ? e.values[2] : 1.0;
    insert.turn_rad = mirrored * e.angles[0] * 3.141592653589793 / 180.0;
    insert.columns = std::max(1LL, e.flags);
    insert.rows = std::max(1LL, e.rows);
    insert.column_spacing = mirrored * e.spacings[0];
    insert.row_spacing = e.spacings[1];
    insert.layer = e.layer;
    insert.line = e.line;
    block.inserts.push_back(std::move(insert));
  }

  static void add_vertices(const std::vector<Vertex>& vertices, bool closed, const DxfPiece& like,
                           std::vector<DxfPiece>& pieces) {
    for (std::size_t i = 0; i + (closed ? 0 : 1) < vertices.size(); ++i) {
      const Vertex& next = vertices[(i + 1) % vertices.size()];
      pieces.push_back({vertices[i].at, next.at, vertices[i].bulge, like.layer, like.line});
    }
  }

  // The vertices of an old polyline follow as entities of their own.
  void polyline(const Entity& head, DxfBlock& block) {
    constexpr long long kNotPlane = 8 | 16 | 64;  // 3D polyline, polygon mesh, polyface mesh
    std::vector<Vertex> vertices;
    while (groups_.is(0, "VERTEX")) {
      const Entity vertex = read_entity();
      vertices.push_back({vertex.first, vertex.has_value[2] ? vertex.values[2] : 0.0});
      if (vertices.size() > VectorMap::kMaxWalls) groups_.fail("too many vertices", "cut the drawing");
    }
    if (head.in_paper_space) return diagnostics_.count("paper space");
    if ((head.flags & kNotPlane & ~8LL) != 0) return diagnostics_.count("entity without walls: mesh");
    const std::size_t before = block.pieces.size();
    const DxfPiece like{{}, {}, 0.0, head.layer, head.line};
    add_vertices(vertices, (head.flags & 1) != 0, like, block.pieces);
    mirror(head, block.pieces, before);
    check_size(block);
  }

  void check_size(const DxfBlock& block) const {
    if (block.pieces.size() + block.inserts.size() > VectorMap::kMaxWalls) {
      groups_.fail("more than 5 million entities", "cut the drawing into smaller ones");
    }
  }

  std::uint32_t layer_of(const std::string& name) {
    const auto [found, is_new] =
        layer_indices_.try_emplace(name, static_cast<std::uint32_t>(drawing_.layers.size()));
    if (is_new) drawing_.layers.push_back(name);
    return found->second;
  }

  DxfGroups groups_;
  Diagnostics& diagnostics_;
  DxfDrawing drawing_;
  std::unordered_map<std::string, std::uint32_t> layer_indices_;
};

}  // namespace

DxfDrawing parse_dxf(std::istream& input, const std::string& name, Diagnostics& diagnostics) {
  return DxfParser(input, name, diagnostics).parse();
}

}  // namespace cairn
