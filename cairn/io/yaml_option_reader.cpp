#include "cairn/io/yaml_option_reader.hpp"

#include "cairn/core/errors.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <sstream>

namespace cairn {
namespace {

// Levenshtein: insertions, deletions and replacements that turn a into b.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

std::string nearest(const std::string& key, const std::vector<std::string>& known) {
  const auto closer = [&](const std::string& a, const std::string& b) {
    return edit_distance(key, a) < edit_distance(key, b);
  };
  const auto best = std::min_element(known.begin(), known.end(), closer);
  return best == known.end() ? "remove it" : "did you mean '" + *best + "'?";
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

YamlOptionReader::YamlOptionReader(const YAML::Node& node, std::string name)
    : node_(node), name_(std::move(name)) {
  if (node_.IsMap() || node_.IsNull()) return;
  throw ConfigurationError(yaml_place(name_, node_.Mark()), "is no list of 'key: value' pairs",
                           "write it as such");
}

YAML::Node YamlOptionReader::find(const Field& field) {
  known_.push_back(field.name);
  if (!node_.IsMap()) return YAML::Node(YAML::NodeType::Undefined);
  const YAML::Node& constant = node_;  // operator[] of a non-const node would add the key
  return constant[field.name];
}

void YamlOptionReader::fail(const YAML::Node& node, const Field& field, const std::string& what,
                            const std::string& remedy) const {
  throw ConfigurationError(yaml_place(name_, node.Mark()), field.name + " " + what, remedy);
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
    fail(node, field, "'" + read + "' is not known", nearest(read, choices));
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
  YamlOptionReader inner(node, name_);
  visit(inner);
  inner.refuse_unknown_keys();
}

void YamlOptionReader::table(const Field& field, const std::vector<std::string>&,
                             const std::function<void(const std::string&, OptionVisitor&)>& visit_entry) {
  const YAML::Node node = find(field);
  if (!node || node.IsNull()) return;
  if (!node.IsMap()) fail(node, field, "is no list of 'name: options' pairs", "write it as such");
  for (const auto& entry : node) {
    YamlOptionReader inner(entry.second, name_);
    visit_entry(entry.first.as<std::string>(), inner);
    inner.refuse_unknown_keys();
  }
}

void YamlOptionReader::refuse_unknown_keys() const {
  if (!node_.IsMap()) return;
  std::set<std::string> seen;
  for (const auto& entry : node_) {
    const auto key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) {
      throw ConfigurationError(yaml_place(name_, entry.first.Mark()), "unknown key '" + key + "'",
                               nearest(key, known_));
    }
    if (!seen.insert(key).second) {
      throw ConfigurationError(yaml_place(name_, entry.first.Mark()), "key '" + key + "' stands twice",
                               "remove one");
    }
  }
}

}  // namespace cairn
