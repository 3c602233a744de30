#include "cairn/io/wean_map.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/gray_image.hpp"
#include "cairn/io/pose_collector.hpp"

#include <cmath>
#include <sstream>

namespace cairn {
namespace {

constexpr std::string_view kPrefix = "robot_specifications->";
constexpr double kMinResolutionCm = 0.01, kMaxResolutionCm = 10000.0;

double bounded(FieldReader& fields, const char* meaning, double min, double max) {
  const double value = fields.number(meaning);
  if (value < min || value > max) fields.fail(std::string(meaning) + " is out of range", "check the header");
  return value;
}

int read_size(FieldReader& fields, const char* meaning) {
  const long long size = fields.integer(meaning);
  if (size < 1 || size > (1 << 30))
    fields.fail(std::string(meaning) + " is out of range", "check the header");
  return static_cast<int>(size);
}

/// Reads header lines up to and including `global_map[0]: NX NY`.
GridGeometry read_header(LineReader& lines) {
  GridGeometry geometry;
  while (next_data_line(lines)) {
    FieldReader fields(lines);
    const std::string_view key = fields.word("key");
    if (key == "robot_specifications->resolution") {
      geometry.resolution_m = 0.01 * bounded(fields, "resolution", kMinResolutionCm, kMaxResolutionCm);
    } else if (key == "robot_specifications->autoshifted_x") {
      geometry.T_map_grid.x = 0.01 * bounded(fields, "shift", -kMaxCoordinateM, kMaxCoordinateM);
    } else if (key == "robot_specifications->autoshifted_y") {
      geometry.T_map_grid.y = 0.01 * bounded(fields, "shift", -kMaxCoordinateM, kMaxCoordinateM);
    } else if (key == "global_map[0]:") {
      geometry.width = read_size(fields, "width");
      geometry.height = read_size(fields, "height");
      return geometry;
    } else if (!key.starts_with(kPrefix)) {
      fields.fail("this is no line of a Wean map's header", "check that it is the right file");
    }
  }
  throw InputError(lines.name(), "has no line 'global_map[0]: width height'", "check for a cut file");
}

void check(const GridGeometry& geometry, std::size_t bytes, const LineReader& lines) {
  if (geometry.resolution_m <= 0.0) {
    throw InputError(lines.name(), "has no line 'robot_specifications->resolution'", "add it (cm)");
  }
  // Every value takes at least two bytes: nothing is allocated that the file cannot fill.
  if (geometry.size() > kMaxCells || geometry.size() > bytes) {
    throw InputError(lines.where(), "announces more cells than the file holds", "check for a cut file");
  }
}

OccupancyGrid::Cell read_cell(FieldReader& fields) {
  const double free = fields.number("cell");
  if (free == -1.0) return OccupancyGrid::kUnknown;
  if (free < 0.0 || free > 1.0) fields.fail("a cell is neither -1 nor within 0..1", "");
  return static_cast<OccupancyGrid::Cell>(std::lround(100.0 * (1.0 - free)));
}

}  // namespace

OccupancyGrid read_wean_map(std::istream& input, const std::string& name) {
  const std::string bytes = read_rest(input);
  std::istringstream text(bytes);
  LineReader lines(text, name);
  const GridGeometry geometry = read_header(lines);
  check(geometry, bytes.size(), lines);
  std::vector<OccupancyGrid::Cell> cells(geometry.size());
  std::size_t count = 0;
  const auto height = static_cast<std::size_t>(geometry.height);
  while (next_data_line(lines)) {
    for (FieldReader fields(lines); !fields.at_end(); ++count) {
      const OccupancyGrid::Cell cell = read_cell(fields);
      if (count == cells.size())
        fields.fail("more cells follow than the header announces", "check the header");
      cells[geometry.index(static_cast<int>(count / height), static_cast<int>(count % height))] = cell;
    }
  }
  if (count < cells.size()) {
    throw InputError(
        lines.where(),
        "the file ends after " + std::to_string(count) + " of " + std::to_string(cells.size()) + " cells",
        "check for a cut file");
  }
  return OccupancyGrid(geometry, std::move(cells));
}

bool looks_like_wean_map(const std::string& first_bytes) { return first_bytes.starts_with(kPrefix); }

}  // namespace cairn
