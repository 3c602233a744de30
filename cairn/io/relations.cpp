#include "cairn/io/relations.hpp"

#include "cairn/core/angle.hpp"
#include "cairn/core/errors.hpp"
#include "cairn/io/input_file.hpp"
#include "cairn/io/pose_collector.hpp"

namespace cairn {

std::vector<Relation> read_relations(std::istream& input, const std::string& name) {
  LineReader lines(input, name);
  std::vector<Relation> relations;
  while (next_data_line(lines)) {
    FieldReader fields(lines, " \t,");
    Relation relation{read_stamp(fields, "first stamp"), read_stamp(fields, "second stamp"), {}};
    relation.T_from_to.x = read_coordinate(fields, "x");
    relation.T_from_to.y = read_coordinate(fields, "y");
    for (const char* dropped : {"z", "roll", "pitch"}) fields.number(dropped);
    relation.T_from_to.theta = normalize_angle(fields.number("yaw"));
    expect_line_end(fields);
    relations.push_back(relation);
  }
  if (relations.empty()) throw InputError(name, "holds no relation", "check that it is the right file");
  return relations;
}

std::vector<Relation> read_relations(const std::filesystem::path& path) {
  return read_relations(*open_input(path), path.string());
}

}  // namespace cairn
