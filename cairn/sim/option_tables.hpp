#pragma once

#include "cairn/core/options.hpp"

#include <string>
#include <vector>

namespace cairn {

/// Visits a list of options as a table: an entry's `name` is its key.
template <typename Entry>
void visit_table(OptionVisitor& visitor, const OptionVisitor::Field& field, std::vector<Entry>& entries) {
  std::vector<std::string> present;
  present.reserve(entries.size());
  for (const Entry& entry : entries) present.push_back(entry.name);
  visitor.table(field, present, [&entries](const std::string& key, OptionVisitor& inner) {
    for (Entry& entry : entries) {
      if (entry.name == key) return entry.visit(inner);
    }
    entries.emplace_back().name = key;
    entries.back().visit(inner);
  });
}

}  // namespace cairn
