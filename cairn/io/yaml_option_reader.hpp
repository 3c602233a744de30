#pragma once

#include "cairn/core/options.hpp"

#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

namespace cairn {

/// Where options come from, for messages.
struct OptionSource {
  std::string name;                     ///< of the file, or the command line's option
  bool has_lines = true;                ///< tell line and column
  std::vector<std::string> paths = {};  ///< dotted names of all options, for suggestions
};

/// "file:line:column", or just the file where the place is not known.
std::string yaml_place(const std::string& name, const YAML::Mark& mark);

/// @throws ConfigurationError if a key of the mapping stands twice or is no single value
void refuse_duplicate_keys(const YAML::Node& mapping, const OptionSource& source);

/// Sets the options that a YAML mapping names. Private to cairn/io (needs yaml-cpp).
class YamlOptionReader final : public OptionVisitor {
 public:
  /// @throws ConfigurationError if the node is no mapping, or a key stands twice in it
  YamlOptionReader(const YAML::Node& node, OptionSource source);

  void number(const Field& field, double& value, Range range) override;
  void integer(const Field& field, int& value, Range range) override;
  void flag(const Field& field, bool& value) override;
  void choice(const Field& field, std::string& value, const std::vector<std::string>& choices) override;
  void text(const Field& field, std::string& value) override;
  void section(const Field& field, const std::function<void(OptionVisitor&)>& visit) override;
  void table(const Field& field, const std::vector<std::string>& present,
             const std::function<void(const std::string&, OptionVisitor&)>& visit_entry) override;

  /// @throws ConfigurationError for a key that no visit has asked for
  void refuse_unknown_keys() const;

 private:
  YAML::Node find(const Field& field);
  void require_group(const YAML::Node& node, const Field& field) const;
  [[noreturn]] void fail(const YAML::Node& node, const Field& field, const std::string& what,
                         const std::string& remedy) const;
  double read_number(const YAML::Node& node, const Field& field, Range range) const;

  YAML::Node node_;
  OptionSource source_;
  std::vector<std::string> known_;
};

}  // namespace cairn
