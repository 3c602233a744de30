#include "cairn/io/geojson.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/wall_collector.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include <nlohmann/json.hpp>

namespace cairn {
namespace {

using Json = nlohmann::json;

constexpr int kMaxDepth = 8;
constexpr std::size_t kPartBytes = 1 << 16;

std::string read_all(std::istream& input, const std::string& name) {
  std::string text;
  std::array<char, kPartBytes> part;
  while (input.read(part.data(), part.size()), input.gcount() > 0) {
    text.append(part.data(), static_cast<std::size_t>(input.gcount()));
    if (text.size() > kMaxGeoJsonBytes) {
      throw InputError(name, "is larger than 256 MiB", "cut the map into smaller ones");
    }
  }
  return text;
}

std::string place_of(const std::string& name, const std::string& text, std::size_t byte) {
  const std::string_view before(text.data(), std::min(byte, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t line_start = before.rfind('\n') + 1;  // 0 if there is none
  return name + ":" + std::to_string(line) + ":" + std::to_string(before.size() - line_start + 1);
}

Json parse(const std::string& text, const std::string& name) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw InputError(place_of(name, text, error.byte > 0 ? error.byte - 1 : 0), "is not JSON here",
                     "write the file again; it may have been cut off");
  } catch (const Json::exception&) {
    throw InputError(name, "holds a number that is out of range", "give map coordinates in metres");
  }
}

// Walks over a document and knows where it is.
class GeoJsonWalk {
 public:
  GeoJsonWalk(std::string name, Diagnostics& diagnostics)
      : name_(std::move(name)), diagnostics_(diagnostics), walls_(name_, diagnostics) {}

  VectorMap map_of(const Json& document) {
    object(document, "");
    return walls_.finish();
  }

 private:
  [[noreturn]] void fail(const std::string& path, const std::string& what, const std::string& remedy) const {
    throw InputError(name_ + " (" + (path.empty() ? "document" : path) + ")", what, remedy);
  }

  const Json& member(const Json& object, const char* key, const std::string& path) const {
    const auto found = object.is_object() ? object.find(key) : object.end();
    if (!object.is_object() || found == object.end()) {
      fail(path, std::string("has no '") + key + "'", "give GeoJSON (RFC 7946)");
    }
    return *found;
  }

  const Json& list(const Json& object, const char* key, const std::string& path) const {
    const Json& value = member(object, key, path);
    if (!value.is_array()) fail(path, std::string("'") + key + "' is no list", "give GeoJSON (RFC 7946)");
    return value;
  }

  std::string type_of(const Json& object, const std::string& path) const {
    const Json& type = member(object, "type", path);
    if (!type.is_string()) fail(path, "'type' is no word", "give GeoJSON (RFC 7946)");
    return type.get<std::string>();
  }

  void object(const Json& json, const std::string& path) {
    const std::string type = type_of(json, path);
    if (type == "FeatureCollection") {
      const Json& features = list(json, "features", path);
      for (std::size_t i = 0; i < features.size(); ++i) {
        feature(features[i], "features[" + std::to_string(i) + "]");
      }
    } else if (type == "Feature") {
      feature(json, path);
    } else {
      geometry(json, path, Material::kOpaque, 0);
    }
  }

  void feature(const Json& json, const std::string& path) {
    const Json& shape = member(json, "geometry", path);
    if (shape.is_null()) return diagnostics_.warn("feature without geometry", path, "left out");
    geometry(shape, path + ".geometry", material_of(json, path), 0);
  }

  Material material_of(const Json& feature, const std::string& path) const {
    const auto properties = feature.find("properties");
    if (properties == feature.end() || !properties->is_object()) return Material::kOpaque;
    const auto material = properties->find("material");
    if (material == properties->end()) return Material::kOpaque;
    if (!material->is_string()) fail(path, "'material' is no word", "use opaque, glass, mesh or mirror");
    try {
      return material_named(material->get_ref<const std::string&>());
    } catch (const InputError&) {
      fail(path, "the material '" + material->get<std::string>() + "' is not known",
           "use opaque, glass, mesh or mirror");
    }
  }

  void geometry(const Json& json, const std::string& path, Material material, int depth) {
    const std::string type = type_of(json, path);
    if (type == "GeometryCollection") return collection(json, path, material, depth);
    const bool is_point = type == "Point" || type == "MultiPoint";
    if (is_point) return diagnostics_.warn(type, name_ + " (" + path + ")", "has no walls and is left out");
    const int nesting = type == "LineString"                             ? 0
                        : type == "MultiLineString" || type == "Polygon" ? 1
                        : type == "MultiPolygon"                         ? 2
                                                                         : -1;
    if (nesting < 0) {
      fail(path, "'" + type + "' is no type of GeoJSON that has walls",
           "use LineString, MultiLineString, Polygon or MultiPolygon");
    }
    lines(list(json, "coordinates", path), path + ".coordinates", material, nesting);
  }

  void collection(const Json& json, const std::string& path, Material material, int depth) {
    if (depth == kMaxDepth) fail(path, "collections are nested more than 8 deep", "flatten them");
    const Json& parts = list(json, "geometries", path);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      geometry(parts[i], path + ".geometries[" + std::to_string(i) + "]", material, depth + 1);
    }
  }

  void lines(const Json& json, const std::string& path, Material material, int nesting) {
    if (!json.is_array()) fail(path, "is no list of coordinates", "give GeoJSON (RFC 7946)");
    if (nesting == 0) return line(json, path, material);
    for (std::size_t i = 0; i < json.size(); ++i) {
      lines(json[i], path + "[" + std::to_string(i) + "]", material, nesting - 1);
    }
  }

  void line(const Json& json, const std::string& path, Material material) {
    if (json.size() < 2) fail(path, "is a line of fewer than two points", "leave it out");
    Point2 before = point(json[0], path, 0);
    for (std::size_t i = 1; i < json.size(); ++i) {
      const Point2 here = point(json[i], path, i);
      walls_.add({before, here, material}, name_ + " (" + path + "[" + std::to_string(i) + "])");
      before = here;
    }
  }

  Point2 point(const Json& json, const std::string& path, std::size_t index) const {
    if (!json.is_array() || json.size() < 2 || !json[0].is_number() || !json[1].is_number()) {
      fail(path + "[" + std::to_string(index) + "]", "is no pair of numbers", "give [x, y] in metres");
    }
    return {json[0].get<double>(), json[1].get<double>()};
  }

  std::string name_;
  Diagnostics& diagnostics_;
  WallCollector walls_;
};

// The shortest text that reads back as the same number, whatever the locale.
void put_number(std::ostream& output, double value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
  output.write(text.data(), end.ptr - text.data());
}

void put_point(std::ostream& output, const Point2& p) {
  output << '[';
  put_number(output, p.x);
  output << ", ";
  put_number(output, p.y);
  output << ']';
}

// Walls that follow each other make one line; returns the first wall after it.
std::size_t put_line(std::ostream& output, const std::vector<Wall>& walls, std::size_t first) {
  output << "     [";
  put_point(output, walls[first].a);
  std::size_t i = first;
  for (; i < walls.size() && walls[i].material == walls[first].material; ++i) {
    if (i > first && walls[i].a != walls[i - 1].b) break;
    output << ", ";
    put_point(output, walls[i].b);
  }
  output << ']';
  return i;
}

}  // namespace

VectorMap read_geojson(std::istream& input, const std::string& name, Diagnostics& diagnostics) {
  return GeoJsonWalk(name, diagnostics).map_of(parse(read_all(input, name), name));
}

bool looks_like_geojson(std::string_view first_bytes) {
  const std::size_t first = first_bytes.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && first_bytes[first] == '{';
}

void write_geojson(std::ostream& output, const VectorMap& map) {
  const std::vector<Wall>& walls = map.walls();
  output << "{\"type\": \"FeatureCollection\", \"features\": [\n";
  for (std::size_t i = 0; i < walls.size();) {
    const Material material = walls[i].material;
    output << " {\"type\": \"Feature\", \"properties\": {\"material\": \"" << name_of(material)
           << "\"},\n  \"geometry\": {\"type\": \"MultiLineString\", \"coordinates\": [\n";
    for (bool more = true; more; output << (more ? ",\n" : "\n")) {
      i = put_line(output, walls, i);
      more = i < walls.size() && walls[i].material == material;
    }
    output << "  ]}}" << (i < walls.size() ? ",\n" : "\n");
  }
  output << "]}\n";
}

}  // namespace cairn
