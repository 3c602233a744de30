#pragma once

#include "cairn/core/relation.hpp"

#include <filesystem>
#include <istream>
#include <string>
#include <vector>

namespace cairn {

/// Relations between pairs of instants: `t1 t2 x y z roll pitch yaw` per line (s, m, rad), blanks or commas
/// between,
/// `#` comments. The planar part is taken; z, roll and pitch must be numbers and are dropped.
/// @throws InputError file:line:column for a malformed line, and if there is no relation
std::vector<Relation> read_relations(std::istream& input, const std::string& name);
std::vector<Relation> read_relations(const std::filesystem::path& path);

}  // namespace cairn
