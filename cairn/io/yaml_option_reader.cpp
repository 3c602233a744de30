#include "cairn/io/yaml_option_reader.hpp"

#include "cairn/core/errors.hpp"
#include "cairn/io/option_suggestion.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace cairn {
namespace {

std::string place(const OptionSource& source, const YAML::Node& node) {
  return source.has_lines ? yaml_place(source.name, node.Mark()) : source.name;
}

std::string range_text(Range range) {
  std::ostringstream text;
  text << "give a value from " << range.min << " to " << range.max;
  return text.str();
}

}  // namespace

std::string yaml_place(const std::string& name, const YAML::Mark& mark) {
  if (mark.is_null()) return name;
  return name + ":" + std::to_string(mark.line + 1) + ":" + std::to_string(mark.column + 1);
}

void refuse_duplicate_keys(const YAML::Node& mapping, const OptionSource& source) {
  std::set<std::string> seen;
  for (const auto& entry : mapping) {
    if (!entry.first.IsScalar()) {
      throw ConfigurationError(place(source, entry.first), "a key is no single word", "write 'key: value'");
    }
    if (!seen.insert(entry.first.Scalar()).second) {
      throw ConfigurationError(place(source, entry.first),
                               "key " + quoted(entry.first.Scalar()) + " stands twice", "remove one");
    }
  }
}

YamlOptionReader::YamlOptionReader(const YAML::Node& node, OptionSource source)
    : node_(node), source_(std::move(source)) {
  if (node_.IsNull()) return;
  if (!node_.IsMap()) {
    throw ConfigurationError(place(source_, node_), "is no list of 'key: value' pairs", "see `cairn config`");
  }
  refuse_duplicate_keys(node_, source_);
}

YAML::Node YamlOptionReader::find(const Field& field) {
  known_.push_back(field.name);
  if (!node_.IsMap()) return YAML::Node(YAML::NodeType::Undefined);
  const YAML::Node& constant = node_;  // operator[] of a non-const node would add the key
  return constant[field.name];
}

void YamlOptionReader::fail(const YAML::Node& node, const Field& field, const std::string& what,
                            const std::string& remedy) const {
  throw ConfigurationError(place(source_, node), field.name + " " + what, remedy);
}

double YamlOptionReader::read_number(const YAML::Node& node, const Field& field, Range range) const {
  double value = 0.0;
  if (!node.IsScalar() || !YAML::convert<double>::decode(node, value))
    fail(node, field, "is no number", range_text(range));
  if (!std::isfinite(value)) fail(node, field, "is not finite", range_text(range));
  if (value < range.min || value > range.max) fail(node, field, "is out of range", range_text(range));
  return value;
}

void YamlOptionReader::number(const Field& field, double& value, Range range) {
  if (const YAML::Node node = find(field)) value = read_number(node, field, range);
}

void YamlOptionReader::integer(const Field& field, int& value, Range range) {
  const YAML::Node node = find(field);
  if (!node) return;
  const double read = read_number(node, field, range);
  if (read != std::floor(read)) fail(node, field, "is no whole number", range_text(range));
  value = static_cast<int>(read);
}

void YamlOptionReader::flag(const Field& field, bool& value) {
  const YAML::Node node = find(field);
  if (!node) return;
  if (!node.IsScalar() || !YAML::convert<bool>::decode(node, value)) {
    fail(node, field, "is neither true nor false", "write one of them");
  }
}

void YamlOptionReader::choice(const Field& field, std::string& value,
                              const std::vector<std::string>& choices) {
  const YAML::Node node = find(field);
  if (!node) return;
  const std::string read = node.IsScalar() ? node.Scalar() : "";
  if (std::find(choices.begin(), choices.end(), read) == choices.end()) {
    fail(node, field, quoted(read) + " is not known", suggest(read, choices));
  }
  value = read;
}

void YamlOptionReader::text(const Field& field, std::string& value) {
  const YAML::Node node = find(field);
  if (!node) return;
  if (!node.IsScalar() && !node.IsNull()) fail(node, field, "is no text", "write a single value");
  value = node.IsNull() ? "" : node.Scalar();
}

void YamlOptionReader::section(const Field& field, const std::function<void(OptionVisitor&)>& visit) {
  const YAML::Node node = find(field);
  if (!node) return;
  require_group(node, field);
  YamlOptionReader inner(node, source_);
  visit(inner);
  inner.refuse_unknown_keys();
}

void YamlOptionReader::table(const Field& field, const std::vector<std::string>&,
                             const std::function<void(const std::string&, OptionVisitor&)>& visit_entry) {
  const YAML::Node node = find(field);
  if (!node) return;
  require_group(node, field);
  refuse_duplicate_keys(node, source_);
  for (const auto& entry : node) {
    require_group(entry.second, {entry.first.Scalar(), ""});
    YamlOptionReader inner(entry.second, source_);
    visit_entry(entry.first.Scalar(), inner);
    inner.refuse_unknown_keys();
  }
}

// A group may be left empty in a file (`filter:` with all its lines commented out), not on the command line.
void YamlOptionReader::require_group(const YAML::Node& node, const Field& field) const {
  if (node.IsMap() || (node.IsNull() && source_.has_lines)) return;
  fail(
      node, field, "is a group of options, not a value",
      source_.has_lines ? "indent its options below it" : "set one of them: " + field.name + ".option=value");
}

void YamlOptionReader::refuse_unknown_keys() const {
  if (!node_.IsMap()) return;
  for (const auto& entry : node_) {
    const std::string& key = entry.first.Scalar();
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    throw ConfigurationError(place(source_, entry.first), "unknown key " + quoted(key),
                             suggest(key, known_, source_.paths));
  }
}

}  // namespace cairn
