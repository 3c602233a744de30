#include "cairn/io/yaml_key_place.hpp"

#include "cairn/io/yaml_document.hpp"
#include "cairn/io/yaml_option_reader.hpp"

namespace cairn {
namespace {

// Names may hold dots themselves, so that a part of the path is found by comparing, not by cutting at the
// dots.
bool begins_with_part(const std::string& path, const std::string& part) {
  return path.compare(0, part.size(), part) == 0 && (path.size() == part.size() || path[part.size()] == '.');
}

// Mark of the deepest key on the path; `found` if there is none.
YAML::Mark find_key(const YAML::Node& node, const std::string& path, const YAML::Mark& found) {
  if (!node.IsMap()) return found;
  for (const auto& entry : node) {
    const std::string& part = entry.first.Scalar();
    if (part.empty() || !begins_with_part(path, part)) continue;
    if (path.size() == part.size()) return entry.first.Mark();
    return find_key(entry.second, path.substr(part.size() + 1), entry.first.Mark());
  }
  return found;
}

}  // namespace

std::string yaml_key_place(const std::string& text, const std::string& name, const std::string& key) {
  try {
    const YAML::Mark mark = find_key(load_yaml(text), key, YAML::Mark::null_mark());
    return yaml_place(name, mark) + ": " + key;
  } catch (const YAML::Exception&) {
    return name + ": " + key;
  }
}

}  // namespace cairn
