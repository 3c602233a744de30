#include "cairn/io/vector_text.hpp"

#include "cairn/io/text_fields.hpp"
#include "cairn/io/wall_collector.hpp"

#include <algorithm>
#include <sstream>

namespace cairn {
namespace {

constexpr std::string_view kSeparators = ", \t";

bool is_skipped(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first == std::string_view::npos || line[first] == '#';
}

}  // namespace

VectorMap read_vector_text(std::istream& input, const std::string& name, Diagnostics& diagnostics) {
  WallCollector walls(name, diagnostics);
  for (LineReader line(input, name); line.next();) {
    if (is_skipped(line.line())) continue;
    FieldReader fields(line, kSeparators);
    Wall wall;
    wall.a.x = fields.number("x1");
    wall.a.y = fields.number("y1");
    wall.b.x = fields.number("x2");
    wall.b.y = fields.number("y2");
    fields.expect_end();
    walls.add(wall, line.where());
  }
  return walls.finish();
}

bool looks_like_vector_text(std::string_view first_bytes) {
  std::istringstream input{std::string(first_bytes)};
  LineReader line(input, "");
  while (line.next()) {
    if (is_skipped(line.line())) continue;
    if (std::count(line.line().begin(), line.line().end(), ',') == 3) {
      return line.line().find_first_not_of("+-.0123456789eE, \t") == std::string_view::npos;
    }
    std::istringstream words{std::string(line.line())};
    double number = 0.0;
    int numbers = 0;
    while (words >> number) ++numbers;
    return words.eof() && numbers == 4;
  }
  return false;
}

}  // namespace cairn
