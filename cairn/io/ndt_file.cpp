#include "cairn/io/ndt_file.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/text_fields.hpp"

#include <charconv>
#include <string_view>

namespace cairn {
namespace {

constexpr std::string_view kMagic = "cairn-ndt";
constexpr int kVersion = 1;
constexpr long long kMostCells = 50'000'000;

std::string text_of(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;  // shortest that reads back
  return {buffer, end};
}

class NdtReader {
 public:
  NdtReader(std::istream& input, const std::string& name) : lines_(input, name) {}

  std::shared_ptr<const NdtMap> read() {
    NdtGeometry geometry;
    FieldReader version = line(kMagic);
    if (version.integer("version") != kVersion) version.fail("is of another version", "use a newer cairn");
    geometry.cell_size_m = line("cell_size_m").number("cell size");
    FieldReader origin = line("origin");
    geometry.T_map_ndt.x = origin.number("x");
    geometry.T_map_ndt.y = origin.number("y");
    geometry.T_map_ndt.theta = origin.number("yaw");
    FieldReader size = line("size");
    geometry.columns = count(size, "columns");
    geometry.rows = count(size, "rows");
    FieldReader number = line("cells");
    return std::make_shared<const NdtMap>(geometry, read_cells(count(number, "number of cells")));
  }

 private:
  // The next line, which begins with `key`.
  FieldReader line(std::string_view key) {
    if (!lines_.next()) throw InputError(lines_.where(), "the file ends too early", "write it anew");
    FieldReader fields(lines_);
    if (fields.word("key") != key) fields.fail("is not '" + std::string(key) + "'", "see ndt_file.hpp");
    return fields;
  }

  static int count(FieldReader& fields, const char* meaning) {
    const long long n = fields.integer(meaning);
    if (n < 0 || n > kMostCells) fields.fail("is out of range", "at most 50 million");
    return static_cast<int>(n);
  }

  std::vector<NdtCell> read_cells(int number) {
    std::vector<NdtCell> cells;  // grows with what is there, not with what the header promises
    for (int i = 0; i < number; ++i) {
      if (!lines_.next()) throw InputError(lines_.where(), "cells are missing", "write it anew");
      FieldReader fields(lines_);
      NdtCell cell;
      cell.index = static_cast<std::uint32_t>(count(fields, "index"));
      cell.points = fields.number("points");
      cell.mean = {fields.number("mean x"), 0.0};
      cell.mean.y = fields.number("mean y");
      cell.xx = fields.number("covariance xx");
      cell.xy = fields.number("covariance xy");
      cell.yy = fields.number("covariance yy");
      cell.occupancy = fields.number("occupancy");
      fields.expect_end();
      cells.push_back(cell);
    }
    return cells;
  }

  LineReader lines_;
};

}  // namespace

void write_ndt(std::ostream& output, const NdtMap& map) {
  const NdtGeometry& g = map.geometry();
  output << kMagic << ' ' << kVersion << "\ncell_size_m " << text_of(g.cell_size_m) << "\norigin "
         << text_of(g.T_map_ndt.x) << ' ' << text_of(g.T_map_ndt.y) << ' ' << text_of(g.T_map_ndt.theta)
         << "\nsize " << g.columns << ' ' << g.rows << "\ncells " << map.cells().size() << '\n';
  for (const NdtCell& c : map.cells()) {
    output << c.index;
    for (const double value : {c.points, c.mean.x, c.mean.y, c.xx, c.xy, c.yy, c.occupancy})
      output << ' ' << text_of(value);
    output << '\n';
  }
}

std::shared_ptr<const NdtMap> read_ndt(std::istream& input, const std::string& name) {
  return NdtReader(input, name).read();
}

bool looks_like_ndt(const std::string& first_bytes) { return first_bytes.starts_with(kMagic); }

}  // namespace cairn
