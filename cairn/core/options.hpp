#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace cairn {

/// Closed interval of allowed values.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

/// Walks over the fields of an option struct, to load, print or check them.
///
/// An option struct has plain members with defaults and a `visit(OptionVisitor&)` that names each of them
/// once; the configuration reader, `cairn config` and the parameter files of other tools all go through it.
/// Names end in their unit (`max_range_m`). `aliases` are names that other tools use for the same thing.
class OptionVisitor {
 public:
  struct Field {
    std::string name;
    std::string documentation;
    std::vector<std::string> aliases = {};
  };

  virtual ~OptionVisitor() = default;
  virtual void number(const Field& field, double& value, Range range) = 0;
  virtual void integer(const Field& field, int& value, Range range) = 0;
  virtual void flag(const Field& field, bool& value) = 0;
  virtual void choice(const Field& field, std::string& value, const std::vector<std::string>& choices) = 0;
  virtual void text(const Field& field, std::string& value) = 0;

  /// A group of fields under one key.
  virtual void section(const Field& field, const std::function<void(OptionVisitor&)>& visit) = 0;
  /// Groups of fields under keys that the user chooses. `visit_entry` makes the entry if there is none.
  virtual void table(const Field& field, const std::vector<std::string>& present,
                     const std::function<void(const std::string& key, OptionVisitor&)>& visit_entry) = 0;
};

}  // namespace cairn
